#!/usr/bin/env python3
"""Reads a `frames` folder with VTK and checks that every file says what its index promises.

    read_with_vtk.py DIR/frames [DIR/frames ...]

Prints a line a kind; exits 1 with a message at the first thing that is wrong.
"""

import math
import sys
import xml.etree.ElementTree as ET
from pathlib import Path

import vtk
from vtk.util.numpy_support import vtk_to_numpy

NEEDED = {
    "grains": {"velocity": 3, "radius": 1, "id": 1},
    "contacts": {"force": 3},
    "walls": {},
    "cells": {},
}


class Wrong(Exception):
    pass


def read(path):
    """The polydata of a file; VTK's own complaints are errors."""
    complaints = []
    reader = vtk.vtkXMLPolyDataReader()
    observer = vtk.vtkOutputWindow()
    vtk.vtkOutputWindow.SetInstance(observer)
    for event in ("ErrorEvent", "WarningEvent"):
        reader.AddObserver(event, lambda *_: complaints.append(event))
    reader.SetFileName(str(path))
    reader.Update()
    if complaints or reader.GetErrorCode():
        raise Wrong(f"{path}: VTK reports {complaints or reader.GetErrorCode()}")
    return reader.GetOutput()


def check(path, kind, time):
    data = read(path)
    points = data.GetNumberOfPoints()
    if points and not math.isfinite(vtk_to_numpy(data.GetPoints().GetData()).sum()):
        raise Wrong(f"{path}: a point is not finite")
    attributes = data.GetPointData()
    arrays = {}
    for i in range(attributes.GetNumberOfArrays()):
        array = attributes.GetArray(i)
        if array.GetNumberOfTuples() != points:
            raise Wrong(f"{path}: {array.GetName()} has {array.GetNumberOfTuples()} rows, not {points}")
        if points and not math.isfinite(float(vtk_to_numpy(array).sum())):
            raise Wrong(f"{path}: {array.GetName()} is not finite")
        info = array.GetInformation()
        key = vtk.vtkDataArray.UNITS_LABEL()
        unit = info.Get(key) if info.Has(key) else "-"
        arrays[array.GetName()] = (array.GetNumberOfComponents(), unit)
    for name, components in NEEDED[kind].items():
        if name not in arrays or arrays[name][0] != components:
            raise Wrong(f"{path}: no {name} with {components} components, only {sorted(arrays)}")
    stamp = data.GetFieldData().GetArray("TimeValue")
    if stamp is None or stamp.GetValue(0) != time:
        raise Wrong(f"{path}: its time is not the {time} of the index")
    cells = data.GetNumberOfCells()
    if points and not cells:
        raise Wrong(f"{path}: points without cells are invisible")
    return points, cells, arrays


def check_folder(folder):
    indices = sorted(folder.glob("*.pvd"))
    if not indices:
        raise Wrong(f"{folder}: no .pvd index")
    for index in indices:
        kind = index.stem
        entries = ET.parse(index).getroot().findall("./Collection/DataSet")
        points = cells = 0
        arrays = {}
        for entry in entries:
            p, c, arrays = check(folder / entry.get("file"), kind, float(entry.get("timestep")))
            points, cells = points + p, cells + c
        listing = ", ".join(f"{name} [{unit}]" for name, (_, unit) in sorted(arrays.items()))
        print(f"{kind}: {len(entries)} files, {points} points, {cells} cells: {listing}")


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    try:
        for argument in sys.argv[1:]:
            check_folder(Path(argument))
    except Wrong as error:
        sys.exit(str(error))
