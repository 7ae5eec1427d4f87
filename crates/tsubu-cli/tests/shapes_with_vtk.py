#!/usr/bin/env python3
"""Draws the meshes in `shapes` at the rows of the last snapshot, as a program that shows frames does, and holds them against the run.

    shapes_with_vtk.py DIR DENSITY

A body has the mass of its mesh, and its contacts lie on it; turned the other way round they do not. Prints a line a group; exits 1 with a
message at the first thing that is wrong.
"""

import sys
from pathlib import Path

import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy


def read(path):
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def columns(data):
    rows = data.GetPointData()
    named = {rows.GetArrayName(k): vtk_to_numpy(rows.GetArray(k)) for k in range(rows.GetNumberOfArrays())}
    return named | {"position": vtk_to_numpy(data.GetPoints().GetData())}


def volume(mesh):
    triangles = vtk.vtkTriangleFilter()
    triangles.SetInputData(mesh)
    clean = vtk.vtkCleanPolyData()
    clean.SetInputConnection(triangles.GetOutputPort())
    mass = vtk.vtkMassProperties()
    mass.SetInputConnection(clean.GetOutputPort())
    return mass.GetVolume()


def placed(mesh, centre, radius, quaternion):
    """The mesh as glyph mappers place it: scaled, turned by a quaternion with its real part first, moved."""
    rotation = np.zeros((3, 3))
    vtk.vtkMath.QuaternionToMatrix3x3(quaternion, rotation)
    matrix = np.eye(4)
    matrix[:3, :3] = radius * rotation
    matrix[:3, 3] = centre
    transform = vtk.vtkTransform()
    transform.SetMatrix(matrix.ravel())
    turned = vtk.vtkTransformFilter()
    turned.SetInputData(mesh)
    turned.SetTransform(transform)
    surface = vtk.vtkImplicitPolyDataDistance()
    turned.Update()
    triangles = vtk.vtkTriangleFilter()
    triangles.SetInputData(turned.GetOutput())
    triangles.Update()
    surface.SetInput(triangles.GetOutput())
    return surface


def farthest(mesh, grains, contacts, own, turn):
    """How far contacts lie from the surface, beyond half of the overlap, over the radius: of all rows `own`, the mean of the worst of each."""
    worst = []
    for row in own:
        here = contacts["first"] == grains["id"][row]
        if not here.any():
            continue
        surface = placed(mesh, grains["position"][row], grains["radius"][row], turn(grains["orientation"][row]))
        apart = [abs(surface.EvaluateFunction(point)) for point in contacts["position"][here]]
        worst.append(max(np.array(apart) - 0.5 * contacts["overlap"][here]) / grains["radius"][row])
    return np.mean(worst), len(worst)


def main(folder, density):
    last = sorted(folder.glob("frames/grains_*.vtp"))[-1]
    grains = columns(read(last))
    contacts = columns(read(last.with_name(last.name.replace("grains", "contacts"))))
    meshes = sorted(folder.glob("shapes/*.vtp"))
    for path in meshes:
        mesh = read(path)
        own = np.flatnonzero(grains["group"] == int(path.stem.split("-")[0]))
        mass = density * volume(mesh) * grains["radius"][own] ** 3
        share = (mass / grains["mass"][own]).mean()
        if not 0.98 < share <= 1:
            sys.exit(f"{path}: the mesh has {share:.4f} of the mass of its grains")
        right, touched = farthest(mesh, grains, contacts, own, lambda q: q)
        wrong, _ = farthest(mesh, grains, contacts, own, lambda q: q * [1, -1, -1, -1])
        if touched < 5 or not abs(right) < 0.01 or not wrong > 0.05:
            sys.exit(f"{path}: {touched} touched bodies have contacts {right:.4f} off, turned back {wrong:.4f}")
        print(f"{path.name}: {share:.4f} of the mass, contacts {right:.4f} radii off, turned back {wrong:.4f}")
    print(f"{len(meshes)} meshes")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(Path(sys.argv[1]), float(sys.argv[2]))
