plate
of triangles
node id off
element id off
part
         1
sheet
coordinates
         4
 0.00000e+00
 1.00000e+00
 1.00000e+00
 0.00000e+00
 0.00000e+00
 0.00000e+00
 1.00000e+00
 1.00000e+00
 0.00000e+00
 0.00000e+00
 0.00000e+00
 0.00000e+00
tria3
         2
         1         2         3
         1         3         4
