"""Draws the crack of a result of Perilink in ParaView 5.11 or later, at all rows with fields.

In ParaView: open fields.pvd, press Apply, then Tools > Python Shell > Run Script; the arrows of the
toolbar go through the rows. From a shell:

    paraview --script=crack.py                       # in the directory of the result
    pvpython crack.py DIR PICTURE.png [ROW]          # a picture of the last row, or of another one

Change the names in capitals to see other things.
"""

import sys

import paraview.simple as pv

FIELD = "damage"  # colours: also "crack_opening", "principal_strain", "stress", ...
FACTOR = None  # factor on the displacements; None: a tenth of the body at the last row
CRACKED = 0.3  # in space particles of at least this damage are seen through the body


def part(source, array, low, high, kind="POINTS"):
    """Returns the cells or points with values from low to high."""
    found = pv.Threshold(Input=source, Scalars=[kind, array])
    found.LowerThreshold, found.UpperThreshold = low, high
    found.ThresholdMethod = "Between"
    return found


def shown(source, view, representation, **properties):
    display = pv.Show(source, view)
    display.SetRepresentationType(representation)
    for name, value in properties.items():
        setattr(display, name, value)
    return display


def automatic_factor(reader, size):
    largest = reader.PointData["displacement"].GetRange(-1)[1]
    return 0.1 * size / largest if largest > 0.0 else 1.0


def draw(reader, view):
    """Draws solid and bars; broken bonds and points of bars are left out."""
    reader.UpdatePipeline(reader.TimestepValues[-1])
    bounds = reader.GetDataInformation().GetBounds()
    sides = [bounds[2 * k + 1] - bounds[2 * k] for k in range(3)]
    factor = FACTOR or automatic_factor(reader, sum(side**2 for side in sides) ** 0.5)
    moved = pv.WarpByVector(Input=reader, Vectors=["POINTS", "displacement"], ScaleFactor=factor)
    kinds = reader.CellData["element"].GetRange()[1]
    spacing = pv.servermanager.Fetch(reader).GetFieldData().GetArray("spacing").GetValue(0)

    is_solid = min(sides) > 1.5 * spacing
    in_space = is_solid or any(reader.PointData["displacement"].GetRange(2))
    if in_space:
        view.ApplyIsometricView()
    dots = {"GaussianRadius": 0.55 * spacing,
            "ShaderPreset": "Sphere" if in_space else "Plain circle"}
    solid = part(moved, "kind", 0, 0)
    if kinds >= 5:  # [output] body_cells = true: a surface, in which cracks are gaps
        body, look, properties = part(solid, "element", 5, 5, "CELLS"), "Surface", {}
    else:
        body, look, properties = part(solid, "element", 0, 0, "CELLS"), "Point Gaussian", dots
    names = reader.PointData.keys()
    damage = reader.PointData["damage"].GetRange()[1] if "damage" in names else 0.0
    hides = is_solid and damage >= CRACKED  # the crack, which lies inside
    drawn = [shown(body, view, look, Opacity=0.15 if hides else 1.0, **properties)]
    if hides:
        faces = part(part(solid, "element", 0, 0, "CELLS"), "damage", CRACKED, 1.0)
        drawn.append(shown(faces, view, "Point Gaussian", **dots))
    field = FIELD if FIELD in names and (FIELD != "damage" or damage > 0.0) else "displacement"
    for display in drawn:
        pv.ColorBy(display, ("POINTS", field))
        display.RescaleTransferFunctionToDataRange(True, True)
    colors = pv.GetColorTransferFunction(field)
    if field == "damage":
        colors.RescaleTransferFunction(0.0, 1.0)
    drawn[0].SetScalarBarVisibility(view, True)
    bar = pv.GetScalarBar(colors, view)
    bar.TitleColor = bar.LabelColor = [0.0, 0.0, 0.0]
    if kinds >= 2:
        bars = shown(part(moved, "element", 2, 2, "CELLS"), view, "Surface", LineWidth=3.0)
        bars.ColorArrayName = ["POINTS", ""]
        bars.DiffuseColor = bars.AmbientColor = [0.2, 0.2, 0.2]
        bars.Position = [0.0, 0.0, 0.0 if in_space else spacing]  # before the particles
    print(f"displacements times {factor:.3g}, coloured by {field}")


def main(arguments):
    reader = pv.GetActiveSource()
    if reader is None:
        reader = pv.PVDReader(FileName=f"{arguments[0] if arguments else '.'}/fields.pvd")
    view = pv.GetActiveViewOrCreate("RenderView")
    view.UseColorPaletteForBackground = 0
    view.Background = [1.0, 1.0, 1.0]
    pv.HideAll(view)
    if len(arguments) > 1:
        view.ViewSize = [1200, 800]
    rows = list(reader.TimestepValues)
    time = min(rows, key=lambda row: abs(row - float(arguments[2]))) if arguments[2:] else rows[-1]
    pv.GetAnimationScene().AnimationTime = view.ViewTime = time
    draw(reader, view)
    pv.ResetCamera(view)
    pv.Render(view)
    if len(arguments) > 1:
        pv.SaveScreenshot(arguments[1], view)


main(sys.argv[1:])
