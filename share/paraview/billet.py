"""Opens the results of a run of billet in ParaView: the part coloured by a field, the tools as
glass, and the forces of the tools over their strokes next to it.

As a macro: Macros > Import new macro..., choose this file; then select the .pvd of the results in
the pipeline browser, or let the macro ask for the folder.
From a shell, without a window: pvbatch billet.py RESULTS [-o PICTURE.png] [--field NAME[:COMPONENT]]

Made for ParaView 5.11.
"""

import argparse
import csv
import json
import math
import pathlib
import re
import sys

from paraview import servermanager, simple

GLASS = [0.50, 0.58, 0.70]


def folder_from_pipeline():
    """The folder of the file that is selected in the pipeline browser, or None."""
    source = simple.GetActiveSource()
    names = getattr(source, "FileName", None) if source else None
    if not names:
        return None
    path = pathlib.Path(names if isinstance(names, str) else names[0])
    return path.parent.parent if path.parent.name == "frames" else path.parent


def folder_from_dialog():
    """The folder that the user chooses; only where there is a window."""
    try:
        from PyQt5.QtWidgets import QFileDialog  # not part of every ParaView
    except ImportError:
        sys.exit("select the .pvd of the results in the pipeline browser, then run the macro again")
    chosen = QFileDialog.getExistingDirectory(None, "Folder of results")
    return pathlib.Path(chosen) if chosen else None


def texts(data):
    """Facts of a frame: "title", "unit of von_mises", ... as they stand in its field data."""
    field = data.GetFieldData()
    names = [field.GetArrayName(i) or "" for i in range(field.GetNumberOfArrays())]
    return dict(name.split(": ", 1) for name in names if ": " in name)


def blocks(data):
    """Parts of a frame by their names."""
    found = {}
    for i in range(data.GetNumberOfBlocks()):
        info = data.GetMetaData(i)
        found[info.Get(data.NAME()) if info and info.Has(data.NAME()) else f"part {i}"] = i
    return found


def travels(folder):
    """{tool: [(stroke, force), ...]} of the tools that travel, from history.csv."""
    with open(folder / "history.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    curves = {}
    tools = ".displacement_x"  # supports with a name have a force alone
    for name in [c[:-len(tools)] for c in rows[0] if c.endswith(tools)] if rows else []:
        vectors = {what: [[float(row[f"{name}.{what}_{axis}"]) for axis in "xyz"] for row in rows]
                   for what in ("force", "displacement")}
        longest = max(vectors["displacement"], key=lambda v: math.hypot(*v))
        length = math.hypot(*longest)
        if length > 0.0:
            along = [c / length for c in longest]
            dot = lambda v: sum(a * b for a, b in zip(v, along))
            curves[name] = [(0.0, 0.0)] + [(dot(u), -dot(f)) for u, f in
                                           zip(vectors["displacement"], vectors["force"])]
    return curves


def units(folder):
    """Of stroke and force, in brackets; of a run that goes on they are not known."""
    try:
        summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
        length, force = summary["units"].split("-")[:2]
    except (OSError, ValueError, KeyError):
        return "", ""
    return f" [{length}]", f" [{force}/{length}]" if summary.get("analysis") == "plane-strain" else f" [{force}]"


def add_part(reader, name, view):
    """One part of the frames as a source of its own."""
    part = simple.ExtractBlock(registrationName=name, Input=reader)
    # ParaView's names of blocks have letters, digits and '_' only: "toolpunch" of "tool-punch".
    part.Selectors = ["/Root/" + re.sub(r"\W", "", name)]
    return part, simple.Show(part, view)


def colour(part, display, view, field, notes):
    """Colours the part by a field over the range of all frames, with its unit at the scale."""
    array, _, component = field.partition(":")
    information = part.GetPointDataInformation()
    known = [information.GetArray(i).GetName() for i in range(information.GetNumberOfArrays())]
    if array not in known:
        sys.exit(f'the results have no "{array}" at their nodes; they have {", ".join(known)}')
    if component:
        simple.ColorBy(display, ("POINTS", array, component.upper()))
    elif information.GetArray(array).GetNumberOfComponents() > 1:
        simple.ColorBy(display, ("POINTS", array, "Magnitude"))
    else:
        simple.ColorBy(display, ("POINTS", array))
    transfer = simple.GetColorTransferFunction(array)
    transfer.ApplyPreset("Viridis (matplotlib)", True)
    display.RescaleTransferFunctionToDataRangeOverTime()
    bar = simple.GetScalarBar(transfer, view)
    unit = notes.get(f"unit of {array}", "1")
    bar.Title = array if unit == "1" else f"{array} [{unit}]"
    bar.ComponentTitle = component.upper()
    bar.TitleColor = bar.LabelColor = [0.0, 0.0, 0.0]
    display.SetScalarBarVisibility(view, True)


def add_chart(folder, layout):
    """The forces over the strokes in a view next to the part."""
    curves = travels(folder)
    if not curves:
        return
    view = simple.CreateView("XYChartView")
    view.ChartTitle = "force over stroke"
    stroke, force = units(folder)
    view.BottomAxisTitle, view.LeftAxisTitle = f"stroke{stroke}", f"force{force}"
    layout.AssignView(2, view)
    for name, points in curves.items():
        table = simple.ProgrammableSource(registrationName=f"force of {name}")
        table.OutputDataSetType = "vtkTable"
        table.Script = f"""
import numpy
points = numpy.array({points!r})
output.RowData.append(points[:, 0], "stroke")
output.RowData.append(points[:, 1], {name!r})
"""
        display = simple.Show(table, view, "XYChartRepresentation")
        display.UseIndexForXAxis = 0
        display.XArrayName = "stroke"
        display.SeriesVisibility = [name]


def look_at(view, bounds):
    """From the front of a scene of the plane, along a diagonal of a solid."""
    flat = bounds[5] - bounds[4] <= 1e-9 * (bounds[1] - bounds[0] + bounds[3] - bounds[2])
    centre = [0.5 * (bounds[2 * i] + bounds[2 * i + 1]) for i in range(3)]
    towards = (0.0, 0.0, 1.0) if flat else (1.0, -1.3, 0.8)
    view.CameraFocalPoint = centre
    view.CameraPosition = [c + t for c, t in zip(centre, towards)]
    view.CameraViewUp = (0.0, 1.0, 0.0) if flat else (0.0, 0.0, 1.0)
    view.CameraParallelProjection = 1
    simple.ResetCamera(view)


def show(folder, field):
    """Sets the scene; returns its layout."""
    lists = sorted(folder.glob("*.pvd"))
    if len(lists) != 1:
        sys.exit(f"{folder} has {len(lists)} .pvd files, results of a run have one")
    reader = simple.PVDReader(registrationName=lists[0].name, FileName=str(lists[0]))
    simple.UpdatePipeline(proxy=reader)
    scene = simple.GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    scene.GoToLast()
    simple.UpdatePipeline(time=scene.AnimationTime, proxy=reader)
    data = servermanager.Fetch(reader)
    layout = simple.CreateLayout("billet")
    view = simple.CreateView("RenderView")
    layout.AssignView(0, view)
    layout.SplitHorizontal(0, 0.62)
    view.Background = [1.0, 1.0, 1.0]
    view.UseColorPaletteForBackground = 0
    view.OrientationAxesLabelColor = [0.0, 0.0, 0.0]
    bounds = None
    for name, index in blocks(data).items():
        if name == "contact":
            continue
        part, display = add_part(reader, name, view)
        simple.UpdatePipeline(time=scene.AnimationTime, proxy=part)
        if name == "workpiece":
            notes = texts(data.GetBlock(index))
            display.Representation = "Surface With Edges"
            colour(part, display, view, field, notes)
            bounds = part.GetDataInformation().GetBounds()
            simple.SetActiveSource(part)
        else:
            display.ColorArrayName = ["POINTS", ""]
            display.AmbientColor = display.DiffuseColor = GLASS
            display.Opacity = 0.2
            display.LineWidth = 3.0
    add_chart(folder, layout)
    look_at(view, bounds)
    simple.SetActiveView(view)
    simple.Render(view)
    return layout


def main(arguments):
    words = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    words.add_argument("results", nargs="?", type=pathlib.Path, help="folder of a run")
    words.add_argument("-o", "--output", type=pathlib.Path, help="a picture of both views")
    words.add_argument("--field", default="von_mises")
    chosen = words.parse_args(arguments)
    folder = chosen.results or folder_from_pipeline() or folder_from_dialog()
    if folder is None:
        sys.exit("no results were chosen")
    layout = show(folder.resolve(), chosen.field)
    if chosen.output:
        simple.SaveScreenshot(str(chosen.output), layout, ImageResolution=[1600, 700])


# As a macro it has no arguments: those of sys.argv are ParaView's.
main(sys.argv[1:] if sys.argv and pathlib.Path(sys.argv[0]).name == "billet.py" else [])
