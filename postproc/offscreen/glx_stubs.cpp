#include <GL/osmesa.h>

#include <cstring>

/// A VTK built for X11 loads every GL function through GLX and insists on a display. An executable that
/// exports these definitions, which come before those of libGL, makes it take OSMesa's functions instead.
extern "C" {

using GlFunction = void (*)();

void* glXGetCurrentDisplay() {
  static char display = 0;  // only compared with null
  return &display;
}

GlFunction glXGetProcAddressARB(const GLubyte* name) {
  const char* text = reinterpret_cast<const char*>(name);
  if (std::strcmp(text, "glXGetCurrentDisplay") == 0)
    return reinterpret_cast<GlFunction>(&glXGetCurrentDisplay);
  return OSMesaGetProcAddress(text);
}

int glXQueryVersion(void*, int* major, int* minor) {
  *major = 1;
  *minor = 4;
  return 1;
}

const char* glXGetClientString(void*, int) {
  return "";
}
}
