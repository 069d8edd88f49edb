"""Meshes have the points, cells and arrays of the VTU files of `burnish export`."""

import numpy as np
import pytest
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

import burnish
from conftest import call
from scenes import SCENES


def arrays(data):
    return {data.GetArrayName(k): data.GetArray(k) for k in range(data.GetNumberOfArrays())}


def components(array):
    return [array.GetComponentName(k) for k in range(array.GetNumberOfComponents())]


@pytest.mark.parametrize("cells", ["linear", "lagrange", "bezier"])
@pytest.mark.parametrize("name", SCENES)
def test_meshes_are_those_of_export(results, tmp_path, name, cells):
    run = results(name)
    call("export", run.directory, "--cells", cells, "--parts", "body", "-o", tmp_path)
    frame = run.frames[-1]
    for body in run.bodies or [None]:
        reader = vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(tmp_path / f"frames/body{f'_{body}' if body else ''}_{frame.index:06}.vtu"))
        reader.Update()
        theirs, ours = reader.GetOutput(), frame.mesh(cells, body=body)
        points = vtk_to_numpy(theirs.GetPoints().GetData())
        np.testing.assert_allclose(vtk_to_numpy(ours.GetPoints().GetData()), points, rtol=0, atol=1e-13)
        for part in ("GetConnectivityArray", "GetOffsetsArray"):
            assert (vtk_to_numpy(getattr(ours.GetCells(), part)()) == vtk_to_numpy(getattr(theirs.GetCells(), part)())).all()
        assert {ours.GetCellType(k) for k in range(ours.GetNumberOfCells())} == {theirs.GetCellType(0)}
        for data in ("GetPointData", "GetCellData"):
            expected, found = arrays(getattr(theirs, data)()), arrays(getattr(ours, data)())
            assert expected.keys() == found.keys()
            for key, array in expected.items():
                if key == "patch":  # files count those of a body
                    continue
                values = vtk_to_numpy(array)
                np.testing.assert_allclose(vtk_to_numpy(found[key]), values, rtol=0, atol=1e-13 * max(1, np.abs(values).max()))
                assert components(found[key]) == components(array)
        assert bool(ours.GetPointData().GetRationalWeights()) == (cells == "bezier")
        assert bool(ours.GetCellData().GetHigherOrderDegrees()) == (cells != "linear")


def test_all_bodies_in_one_mesh(results):
    frame = results("bodies").frames[-1]
    mesh = frame.mesh("linear", subdivision=2)
    assert mesh.GetNumberOfCells() == 4 * (3 * 5 + 3 * 4)
    strain = vtk_to_numpy(mesh.GetPointData().GetArray("plastic_strain"))
    assert np.isnan(strain).sum() == 7 * 9  # the hub has no plastic strain


def test_undeformed_meshes(press):
    bounds = press.frames[-1].mesh("linear", deformed=False).GetBounds()
    np.testing.assert_allclose(bounds, [0, 2, 0, 1, 0, 0], atol=1e-14)


def test_what_is_no_mesh(press, results):
    with pytest.raises(burnish.Error, match='cells: found "cubic"; available: bezier, lagrange, linear'):
        press.frames[0].mesh("cubic")
    with pytest.raises(burnish.Error, match='body: found "cap"; available: shaft, hub'):
        results("bodies").frames[0].mesh(body="cap")
    with pytest.raises(burnish.Error, match="subdivision: found 0"):
        press.frames[0].mesh("linear", subdivision=0)
