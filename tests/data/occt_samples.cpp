// Wrote tests/data/occt_*.igs with Open CASCADE 7.6.3 (Debian 12); not part of the build:
// g++ -I/usr/include/opencascade occt_samples.cpp -lTKIGES -lTKXSBase -lTKTopAlgo -lTKGeomAlgo
//     -lTKGeomBase -lTKBRep -lTKG3d -lTKG2d -lTKMath -lTKernel
// Model units are millimetres. The surface is that of iges_plain.igs; the loop is the one of
// iges_trimmed_curved.igs.
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepLib.hxx>
#include <Geom2d_BezierCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Writer.hxx>
#include <Interface_Static.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array1OfPnt2d.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>

static Handle(Geom_BSplineSurface) patch()
{
    TColgp_Array2OfPnt poles(1, 6, 1, 5);
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 5; j++)
            poles(i + 1, j + 1) =
                gp_Pnt(1000 * (2.0 * i), 1000 * (0.25 + (i > 0 && i < 5 ? 0.25 * j : 0)),
                       1000 * (0.375 * j + 0.0625 * i * i));
    TColStd_Array1OfReal u(1, 4), v(1, 3);
    TColStd_Array1OfInteger mu(1, 4), mv(1, 3);
    const double ku[4] = {0, 0.4, 0.7, 1}, kv[3] = {0, 0.5, 1};
    for (int k = 1; k <= 4; k++) {
        u(k) = ku[k - 1];
        mu(k) = k == 1 || k == 4 ? 4 : 1;
    }
    for (int k = 1; k <= 3; k++) {
        v(k) = kv[k - 1];
        mv(k) = k == 2 ? 1 : 4;
    }
    return new Geom_BSplineSurface(poles, u, v, mu, mv, 3, 3);
}

// A quarter of a cylinder of radius 2 m and length 5 m.
static Handle(Geom_BSplineSurface) cylinder()
{
    TColgp_Array2OfPnt poles(1, 3, 1, 2);
    TColStd_Array2OfReal weights(1, 3, 1, 2);
    const double x[3] = {2000, 2000, 0}, y[3] = {0, 2000, 2000};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 2; j++) {
            poles(i + 1, j + 1) = gp_Pnt(x[i], y[i], 5000.0 * j);
            weights(i + 1, j + 1) = i == 1 ? std::sqrt(0.5) : 1;
        }
    TColStd_Array1OfReal knots(1, 2);
    TColStd_Array1OfInteger mu(1, 2), mv(1, 2);
    knots(1) = 0;
    knots(2) = 1;
    mu(1) = mu(2) = 3;
    mv(1) = mv(2) = 2;
    return new Geom_BSplineSurface(poles, weights, knots, knots, mu, mv, 2, 1);
}

static Handle(Geom2d_Curve) segment(double u0, double v0, double u1, double v1)
{
    TColgp_Array1OfPnt2d ends(1, 2);
    ends(1) = gp_Pnt2d(u0, v0);
    ends(2) = gp_Pnt2d(u1, v1);
    return new Geom2d_BezierCurve(ends);
}

static TopoDS_Edge edge(const Handle(Geom2d_Curve) & curve, const Handle(Geom_Surface) & surface,
                        double last)
{
    return BRepBuilderAPI_MakeEdge(curve, surface, 0, last);
}

static TopoDS_Face trimmed(const Handle(Geom_Surface) & surface)
{
    TColgp_Array1OfPnt2d poles(1, 3);
    poles(1) = gp_Pnt2d(1, 1);
    poles(2) = gp_Pnt2d(0.5, 0.8);
    poles(3) = gp_Pnt2d(0, 1);
    Handle(Geom2d_Curve) sides[4] = {segment(0, 0, 1, 0), segment(1, 0, 1, 1),
                                     new Geom2d_BezierCurve(poles), segment(0, 1, 0, 0)};
    BRepBuilderAPI_MakeWire wire;
    for (const auto &side : sides)
        wire.Add(edge(side, surface, 1));
    TopoDS_Face face = BRepBuilderAPI_MakeFace(surface, wire.Wire());
    BRepLib::BuildCurves3d(face);
    return face;
}

static void write(const TopoDS_Shape &shape, int brep, const char *path)
{
    IGESControl_Writer writer("MM", brep);
    writer.AddShape(shape);
    writer.ComputeModel();
    writer.Write(path);
}

int main()
{
    IGESControl_Controller::Init();
    write(BRepBuilderAPI_MakeFace(patch(), 1e-6), 0, "occt_bspline.igs");
    write(BRepBuilderAPI_MakeFace(patch(), 1e-6), 1, "occt_bspline_brep.igs");
    write(BRepBuilderAPI_MakeFace(cylinder(), 1e-6), 0, "occt_rational.igs");
    write(trimmed(patch()), 0, "occt_trimmed.igs");
    write(trimmed(patch()), 1, "occt_trimmed_brep.igs");
    return 0;
}
