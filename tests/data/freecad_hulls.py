# Hulls written by FreeCAD, and what it says of them:  freecadcmd freecad_hulls.py  (0.20, Open
# CASCADE 7.6) writes freecad_*.step, freecad_*.igs and freecad_hulls.csv into the current folder.
# Millimetres, x forward, y to port, z up, the still water at z = 0. The volume and the wetted area
# below it are those of Open CASCADE's mass properties after its own cut: faces in the water and in
# the centre plane, and those across the stern, are no wetted area. Both sides, in metres.
import math

import FreeCAD
import Part
from FreeCAD import Base

V = Base.Vector


def breadth(s):
    "Half breadth of the deck, s from the stern (0) to the bow (1)."
    return 700 * (1 - 0.25 * (1 - s) ** 4) * (1 - s ** 3)


def keel(s):
    return -450 + 250 * (1 - s) ** 3 + 60 * s ** 4


def half_section(s, length=10000.0, narrow=25.0):
    "A closed wire: hull from deck to keel, centre plane, deck."
    x, b, k, d = s * length, max(breadth(s), narrow), keel(s), 350 + 80 * s * s
    points = []
    for i in range(9):
        t = i / 8.0
        z = d + (k - d) * t
        flare = (1 - t ** (4 - 2 * s)) ** (0.5 + 0.4 * s)
        points.append(V(x, b * flare if i < 8 else 0, z))
    curve = Part.BSplineCurve()
    curve.interpolate(points)
    edges = [curve.toShape(), Part.makeLine(points[-1], V(x, 0, d)), Part.makeLine(V(x, 0, d), points[0])]
    return Part.Wire(edges)


def loft(parts=5):
    "Part::Loft of a half through closed wires: hull, centre plane, deck, and a narrow stem face."
    return Part.makeLoft([half_section(k / parts) for k in range(parts + 1)], True, False)


def body():
    "A Part Design body: a padded sketch of the profile, pocketed at the sides of the bow, fillets at the bilges."
    profile = Part.makePolygon([V(0, -600, 300), V(8000, -600, 300), V(6800, -600, -400),
                                V(900, -600, -400), V(0, -600, -150), V(0, -600, 300)])
    solid = Part.Face(profile).extrude(V(0, 1200, 0))
    for side in (-1, 1):
        cut = Part.Face(Part.makePolygon([V(5000, side * 600, -500), V(8100, side * 150, -500), V(8100, side * 700, -500),
                                          V(5000, side * 700, -500), V(5000, side * 600, -500)]))
        solid = solid.cut(cut.extrude(V(0, 0, 900)))
    bilge = [e for e in solid.Edges if abs(abs(e.CenterOfMass.y) - 600) < 1 and abs(e.CenterOfMass.z + 400) < 1]
    whole = solid.makeFillet(120, bilge)
    return whole.common(Part.makeBox(20000, 5000, 5000, V(-5000, 0, -2500)))


def copies():
    "A compound of placed copies: a catamaran of two symmetric hulls."
    half = loft(4)
    hull = half.fuse(half.mirror(V(0, 0, 0), V(0, 1, 0))).removeSplitter()
    one, two = hull.copy(), hull.copy()
    one.Placement = FreeCAD.Placement(V(0, 1500, 0), FreeCAD.Rotation())
    two.Placement = FreeCAD.Placement(V(0, -1500, 0), FreeCAD.Rotation())
    return Part.makeCompound([one, two])


def below(shape, sides):
    water = Part.makeBox(30000, 20000, 5000, V(-10000, -10000, -5000))
    wet = shape.common(water)
    area = 0.0
    for face in wet.Faces:
        box = face.BoundBox
        flat = box.ZMin > -1e-6, abs(box.YMin) < 1e-6 and abs(box.YMax) < 1e-6, box.XMax < 1e-6
        area += 0 if any(flat) else face.Area
    return wet.Volume * 1e-9 * sides, area * 1e-6 * sides


half = loft()
mirrored = half.fuse(half.mirror(V(0, 0, 0), V(0, 1, 0))).removeSplitter()
hulls = {
    "loft_half": (half, 2, ("igs",)),
    "loft": (mirrored, 1, ("step",)),
    "body": (body(), 2, ("step", "igs")),
    "copies": (copies(), 1, ("step",)),
}
with open("freecad_hulls.csv", "w") as out:
    out.write("# Written by freecad_hulls.py with FreeCAD %s, Open CASCADE %s: m^3, m^2, both sides, below z = 0.\n"
              % (".".join(FreeCAD.Version()[:2]), Part.OCC_VERSION))
    out.write("file,volume,wetted_area\n")
    for name, (shape, sides, formats) in hulls.items():
        volume, area = below(shape, sides)
        for kind in formats:
            path = "freecad_%s.%s" % (name, kind)
            (shape.exportStep if kind == "step" else shape.exportIges)(path)
            out.write("%s,%.9g,%.9g\n" % (path, volume, area))
print("done")
