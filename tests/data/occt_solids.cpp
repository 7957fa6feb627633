// Wrote tests/data/occt_*.step and occt_barge.igs, and the volumes and areas in tests/nurbs/test_step.c, with Open
// CASCADE 7.6.3 (Debian 12); not part of the build:
// g++ -I/usr/include/opencascade occt_solids.cpp -lTKSTEP -lTKSTEPBase -lTKSTEPAttr -lTKSTEP209 -lTKIGES -lTKXDESTEP
//     -lTKXCAF -lTKLCAF -lTKXSBase -lTKFillet -lTKBool -lTKBO -lTKPrim -lTKShHealing -lTKTopAlgo -lTKGeomAlgo
//     -lTKGeomBase -lTKBRep -lTKG3d -lTKG2d -lTKMath -lTKernel
// The model's unit is the millimetre; lengths below are metres.
#include <BOPAlgo_Splitter.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepGProp.hxx>
#include <BRepLib.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <Geom2d_BezierCurve.hxx>
#include <GeomAPI_PointsToBSpline.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Writer.hxx>
#include <Interface_Static.hxx>
#include <STEPCAFControl_Writer.hxx>
#include <STEPControl_Writer.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array1OfPnt2d.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <cmath>
#include <cstdio>
#include <string>

static gp_Pnt at(double x, double y, double z)
{
    return gp_Pnt(1000 * x, 1000 * y, 1000 * z);
}

static void tell(const char *name, const TopoDS_Shape &shape)
{
    GProp_GProps surface, volume;
    BRepGProp::SurfaceProperties(shape, surface);
    BRepGProp::VolumeProperties(shape, volume);
    int faces = 0;
    for (TopExp_Explorer e(shape, TopAbs_FACE); e.More(); e.Next())
        faces++;
    gp_Pnt c = volume.CentreOfMass();
    std::printf("%-24s faces %d area %.12g volume %.12g centre %.10g %.10g %.10g\n", name, faces,
                surface.Mass() * 1e-6, volume.Mass() * 1e-9, c.X() / 1000, c.Y() / 1000, c.Z() / 1000);
}

static void step(const char *name, const TopoDS_Shape &shape, const char *schema, const char *unit)
{
    Interface_Static::SetCVal("write.step.schema", schema);
    Interface_Static::SetCVal("write.step.unit", unit);
    Interface_Static::SetIVal("write.surfacecurve.mode", std::string(unit) == "MM");
    STEPControl_Writer writer;
    writer.Transfer(shape, STEPControl_AsIs);
    writer.Write(name);
    tell(name, shape);
}

// Box 40 x 10 x 6 whose lower long edges are rounded by 1.5.
static TopoDS_Shape barge()
{
    TopoDS_Shape box = BRepPrimAPI_MakeBox(at(0, -5, 0), at(40, 5, 6));
    BRepFilletAPI_MakeFillet fillet(box);
    for (TopExp_Explorer e(box, TopAbs_EDGE); e.More(); e.Next()) {
        GProp_GProps line;
        BRepGProp::LinearProperties(e.Current(), line);
        gp_Pnt c = line.CentreOfMass();
        if (std::fabs(c.X() - 20000) < 1 && std::fabs(c.Z()) < 1 && line.Mass() > 39000 &&
            !fillet.Contour(TopoDS::Edge(e.Current())))
            fillet.Add(1500, TopoDS::Edge(e.Current()));
    }
    return fillet.Shape();
}

// A cylinder with a cone before it, a half sphere behind it and a quarter torus of pipe through its side.
static TopoDS_Shape bodies()
{
    gp_Ax2 axis(at(0, 0, 0), gp_Dir(1, 0, 0));
    TopoDS_Shape hull = BRepPrimAPI_MakeCylinder(axis, 2000, 10000);
    TopoDS_Shape nose = BRepPrimAPI_MakeCone(gp_Ax2(at(10, 0, 0), gp_Dir(1, 0, 0)), 2000, 500, 4000);
    TopoDS_Shape tail = BRepPrimAPI_MakeSphere(axis, 2000);
    TopoDS_Shape pipe = BRepPrimAPI_MakeTorus(gp_Ax2(at(5, 0, 2), gp_Dir(0, 1, 0)), 3000, 400);
    TopoDS_Shape body = BRepAlgoAPI_Fuse(BRepAlgoAPI_Fuse(hull, nose), tail);
    return BRepAlgoAPI_Fuse(body, pipe);
}

// Half hull 60 long, 4.5 half broad, 5 deep: a B-spline surface of degree 3 x 3 with 7 x 6 poles.
static TopoDS_Face hull()
{
    const double girth[6][2] = {{1, 0.2}, {1, -0.25}, {0.97, -0.6}, {0.8, -0.95}, {0.4, -1}, {0, -1}};
    TColgp_Array2OfPnt poles(1, 7, 1, 6);
    for (int i = 0; i < 7; i++) {
        double x = 10.0 * i, f = 1 - std::pow((x - 28) / 34, 2);
        for (int j = 0; j < 6; j++)
            poles(i + 1, j + 1) = at(x, 4.5 * f * girth[j][0], 5 * std::sqrt(f) * girth[j][1]);
    }
    TColStd_Array1OfReal u(1, 5), v(1, 4);
    TColStd_Array1OfInteger mu(1, 5), mv(1, 4);
    for (int k = 1; k <= 5; k++) {
        u(k) = k - 1;
        mu(k) = k == 1 || k == 5 ? 4 : 1;
    }
    for (int k = 1; k <= 4; k++) {
        v(k) = k - 1;
        mv(k) = k == 1 || k == 4 ? 4 : 1;
    }
    return BRepBuilderAPI_MakeFace(new Geom_BSplineSurface(poles, u, v, mu, mv, 3, 3), 1e-6);
}

// The same in eight trimmed faces: four by two cells of the parameter plane between slanted straight lines. Only where
// their edges are parameter lines do neighbours share the curve itself; together they have the area of the whole.
static TopoDS_Shape eight()
{
    TopoDS_Face whole = hull();
    Handle(Geom_Surface) surface = BRep_Tool::Surface(whole);
    const double u[5][3] = {{0, 0, 0}, {0.9, 1.1, 1.2}, {2, 1.8, 2.1}, {3, 3.2, 3}, {4, 4, 4}},
                 v[5][3] = {{0, 1.2, 3}, {0, 1.3, 3}, {0, 1.1, 3}, {0, 1.4, 3}, {0, 1.2, 3}};
    TopoDS_Compound faces;
    BRep_Builder builder;
    builder.MakeCompound(faces);
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 2; j++) {
            const int at[5][2] = {{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}, {i, j}};
            BRepBuilderAPI_MakeWire wire;
            for (int k = 0; k < 4; k++) {
                TColgp_Array1OfPnt2d ends(1, 2);
                for (int e = 0; e < 2; e++)
                    ends(e + 1) = gp_Pnt2d(u[at[k + e][0]][at[k + e][1]], v[at[k + e][0]][at[k + e][1]]);
                Handle(Geom2d_Curve) line = new Geom2d_BezierCurve(ends);
                wire.Add(BRepBuilderAPI_MakeEdge(line, surface, 0, 1).Edge());
            }
            TopoDS_Face face = BRepBuilderAPI_MakeFace(surface, wire.Wire());
            BRepLib::BuildCurves3d(face, 1e-4);
            builder.Add(faces, face);
        }
    tell("hull", whole);
    return faces;
}

// The closed half hull: a block cut by the surface, below the level z = -0.5.
static TopoDS_Shape ship()
{
    BOPAlgo_Splitter splitter;
    splitter.AddArgument(BRepPrimAPI_MakeBox(at(0.5, 0, -8), at(59.5, 10, -0.5)));
    splitter.AddTool(hull());
    splitter.Perform();
    TopoDS_Shape least;
    double smallest = 1e300;
    for (TopExp_Explorer e(splitter.Shape(), TopAbs_SOLID); e.More(); e.Next()) {
        GProp_GProps volume;
        BRepGProp::VolumeProperties(e.Current(), volume);
        if (volume.Mass() < smallest) {
            smallest = volume.Mass();
            least = e.Current();
        }
    }
    return least;
}

// Extruded and revolved splines and ellipses.
static TopoDS_Shape swept()
{
    TColgp_Array1OfPnt points(1, 5);
    const double y[5] = {1, 1.6, 1.2, 1.9, 1};
    for (int k = 0; k < 5; k++)
        points(k + 1) = at(0, y[k], 1.5 * k);
    Handle(Geom_BSplineCurve) curve = GeomAPI_PointsToBSpline(points, 3, 3, GeomAbs_C2, 1e-3).Curve();
    BRepBuilderAPI_MakeWire profile(BRepBuilderAPI_MakeEdge(curve).Edge());
    profile.Add(BRepBuilderAPI_MakeEdge(at(0, 1, 6), at(0, 0, 6)));
    profile.Add(BRepBuilderAPI_MakeEdge(at(0, 0, 6), at(0, 0, 0)));
    profile.Add(BRepBuilderAPI_MakeEdge(at(0, 0, 0), at(0, 1, 0)));
    TopoDS_Shape vase = BRepPrimAPI_MakeRevol(BRepBuilderAPI_MakeFace(profile.Wire()).Face(),
                                              gp_Ax1(at(0, 0, 0), gp_Dir(0, 0, 1)));
    gp_Elips ellipse(gp_Ax2(at(10, 0, 0), gp_Dir(0, 0, 1)), 3000, 1000);
    BRepBuilderAPI_MakeWire rim(BRepBuilderAPI_MakeEdge(ellipse).Edge());
    TopoDS_Shape strut = BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(rim.Wire()).Face(), gp_Vec(500, 0, 4000));
    TopoDS_Compound both;
    BRep_Builder builder;
    builder.MakeCompound(both);
    builder.Add(both, vase);
    builder.Add(both, strut);
    return both;
}

// Two cylinders and a box, placed by an assembly inside an assembly.
static void assembly(const char *name)
{
    Handle(TDocStd_Document) document;
    XCAFApp_Application::GetApplication()->NewDocument("MDTV-XCAF", document);
    Handle(XCAFDoc_ShapeTool) tool = XCAFDoc_DocumentTool::ShapeTool(document->Main());
    TDF_Label part = tool->AddShape(BRepPrimAPI_MakeCylinder(500, 3000).Shape(), Standard_False);
    TDF_Label box = tool->AddShape(BRepPrimAPI_MakeBox(1000, 2000, 3000).Shape(), Standard_False);
    TDF_Label pair = tool->NewShape(), whole = tool->NewShape();
    gp_Trsf left, right, turned, far;
    left.SetTranslation(gp_Vec(0, 2000, 0));
    right.SetTranslation(gp_Vec(0, -2000, 0));
    turned.SetRotation(gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1)), M_PI / 2);
    turned.SetTranslationPart(gp_Vec(10000, 0, 0));
    far.SetTranslation(gp_Vec(0, 0, 7000));
    tool->AddComponent(pair, part, TopLoc_Location(left));
    tool->AddComponent(pair, part, TopLoc_Location(right));
    tool->AddComponent(whole, pair, TopLoc_Location(turned));
    tool->AddComponent(whole, box, TopLoc_Location(far));
    tool->UpdateAssemblies();
    Interface_Static::SetCVal("write.step.schema", "AP242DIS");
    Interface_Static::SetCVal("write.step.unit", "MM");
    STEPCAFControl_Writer writer;
    writer.Transfer(document, STEPControl_AsIs);
    writer.Write(name);
    tell(name, tool->GetShape(whole));
}

int main()
{
    STEPControl_Writer first; // sets the parameters up
    step("occt_barge.step", barge(), "AP214IS", "MM");
    step("occt_barge_m.step", barge(), "AP203", "M");
    step("occt_bodies.step", bodies(), "AP214IS", "MM");
    step("occt_eight.step", eight(), "AP214IS", "M");
    step("occt_ship.step", ship(), "AP203", "INCH");
    step("occt_swept.step", swept(), "AP242DIS", "MM");
    assembly("occt_assembly.step");
    IGESControl_Controller::Init();
    for (int brep = 0; brep < 2; brep++) {
        IGESControl_Writer writer("MM", brep);
        writer.AddShape(brep ? bodies() : barge());
        writer.ComputeModel();
        writer.Write(brep ? "occt_bodies.igs" : "occt_barge.igs");
    }
    return 0;
}
