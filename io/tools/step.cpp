#include "io/tools/step.h"

#include <fmt/format.h>

#ifdef BILLET_STEP
#include <BRepBndLib.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <IFSelect_ReturnStatus.hxx>
#include <IMeshTools_Parameters.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Poly_Triangulation.hxx>
#include <STEPControl_Reader.hxx>
#include <Standard_Failure.hxx>
#include <TopAbs_ShapeEnum.hxx>
#include <TopExp_Explorer.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>
#endif

namespace billet::io {

#ifdef BILLET_STEP

namespace {

constexpr double usual_chord_error = 2e-4; // of the diagonal of the box
constexpr double least_chord_error = 1e-5; // of it; a ball takes half a million facets and 3 GB
constexpr double most_chord_error = 0.01;  // of it
constexpr double most_turn = 0.1;          // from facet to facet of a curved face [rad]

[[noreturn]] void
refuse(const std::filesystem::path& path, const std::string& why, const std::string& remedy) {
  throw Error(Fault::geometry, path.string(), why, remedy, error_code::surface_file);
}

/// The text of the file; OpenCASCADE is given it once it is known to be there and to be STEP.
std::string text_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream || std::filesystem::is_directory(path))
    throw Error(Fault::input_output, path.string(), "cannot be read");
  std::ostringstream text;
  text << stream.rdbuf();
  return std::move(text).str();
}

/// A number that the file refers to by #number and does not define; none: it is whole. Without it
/// OpenCASCADE may put something huge in the place of what is missing, and mesh that.
std::optional<std::int64_t> missing_entity(const std::string& text) {
  std::set<std::int64_t> defined, wanted;
  bool quoted = false, begins = true; // an entity, after a semicolon
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!quoted && text.compare(i, 2, "/*") == 0) {
      const std::size_t end = text.find("*/", i + 2);
      if (end == std::string::npos)
        break;
      i = end + 1;
      continue;
    }
    const char c = text[i];
    if (c == '\'')
      quoted = !quoted;
    else if (quoted || std::isspace(static_cast<unsigned char>(c)) != 0)
      continue;
    else if (c == '#')
      (begins ? defined : wanted).insert(std::strtoll(text.c_str() + i + 1, nullptr, 10));
    begins = c == ';';
  }
  const auto missing = std::find_if(wanted.begin(), wanted.end(),
                                    [&](std::int64_t entity) { return !defined.contains(entity); });
  return missing != wanted.end() ? std::optional(*missing) : std::nullopt;
}

TopoDS_Shape shape_in(const std::filesystem::path& path) {
  const std::string text = text_of(path);
  if (text.find("ISO-10303-21") == std::string::npos)
    refuse(path, "is not a STEP file: 'ISO-10303-21' is missing",
           "export the part as STEP AP203, AP214 or AP242");
  if (text.find("END-ISO-10303-21") == std::string::npos)
    refuse(path, "has been cut short: 'END-ISO-10303-21' is missing", "export it again");
  if (const std::optional<std::int64_t> entity = missing_entity(text))
    refuse(path, fmt::format("is damaged: it refers to #{}, which it does not hold", *entity),
           "export it again");
  Message::DefaultMessenger()->ChangePrinters().Clear(); // it would write to the user's screen
  STEPControl_Reader reader;
  Interface_Static::SetCVal("xstep.cascade.unit", "MM");
  std::istringstream stream(text);
  if (reader.ReadStream(path.filename().c_str(), stream) != IFSelect_RetDone)
    refuse(path, "cannot be read as STEP", "export it again, as STEP AP203, AP214 or AP242");
  reader.TransferRoots();
  if (reader.NbShapes() == 0)
    refuse(path, "holds no shape", "export the faces of the tool, not its drawing");
  return reader.OneShape();
}

/// Appends the triangles of a face; without a triangulation, false.
bool add_triangles(const TopoDS_Face& face, std::vector<std::array<Vec3, 3>>& facets) {
  TopLoc_Location location;
  const Handle(Poly_Triangulation) triangles = BRep_Tool::Triangulation(face, location);
  if (triangles.IsNull())
    return false;
  const auto corner = [&](int node) {
    const gp_Pnt p = triangles->Node(node).Transformed(location.Transformation());
    return Vec3(p.X(), p.Y(), p.Z());
  };
  for (int i = 1; i <= triangles->NbTriangles(); ++i) {
    int a = 0, b = 0, c = 0;
    triangles->Triangle(i).Get(a, b, c);
    if (face.Orientation() == TopAbs_REVERSED)
      std::swap(b, c);
    facets.push_back({corner(a), corner(b), corner(c)});
  }
  return true;
}

FacetFile triangulated(const std::filesystem::path& path,
                       const std::optional<double>& chord_error) {
  const TopoDS_Shape shape = shape_in(path);
  Bnd_Box box;
  BRepBndLib::Add(shape, box);
  if (box.IsVoid() || !TopExp_Explorer(shape, TopAbs_FACE).More())
    refuse(path, "holds no face", "export the faces of the tool, not only its edges");
  IMeshTools_Parameters parameters;
  const double size = std::sqrt(box.SquareExtent());
  const double wanted = chord_error.value_or(usual_chord_error * size);
  if (wanted < least_chord_error * size)
    refuse(path,
           fmt::format("a chord error of {:.3g} mm on a part of {:.4g} mm takes too many facets",
                       wanted, size),
           fmt::format("ask for {:.1g} mm or more", least_chord_error * size));
  // OpenCASCADE's own bound is exceeded by two thirds inside the faces of a ball; a bound as large
  // as the part makes it forget the angle.
  parameters.Deflection = std::min(0.5 * wanted, most_chord_error * size);
  parameters.Angle = most_turn;
  const BRepMesh_IncrementalMesh mesh(shape, parameters);
  FacetFile file{path, FacetFormat::step, {}, {}, 0, {}};
  int faces = 0, failed = 0;
  for (TopExp_Explorer at(shape, TopAbs_FACE); at.More(); at.Next(), ++faces)
    failed += add_triangles(TopoDS::Face(at.Current()), file.facets) ? 0 : 1;
  if (failed > 0)
    refuse(path, fmt::format("{} of its {} faces could not be cut into triangles", failed, faces),
           "heal the part in the CAD program, or export it from there as STL");
  return file;
}

} // namespace

bool reads_step() { return true; }

FacetFile read_step(const std::filesystem::path& path, const std::optional<double>& chord_error) {
  try {
    return triangulated(path, chord_error);
  } catch (const Standard_Failure& failure) {
    refuse(path, fmt::format("OpenCASCADE could not read it: {}", failure.GetMessageString()),
           "export it again, or as STL");
  }
}

#else

bool reads_step() { return false; }

FacetFile read_step(const std::filesystem::path& path,
                    const std::optional<double>& /*chord_error*/) {
  throw Error(Fault::geometry, path.string(), "this build does not read STEP files",
              "build with './dev build --step', or export the tool from CAD as STL",
              error_code::surface_file);
}

#endif

} // namespace billet::io
