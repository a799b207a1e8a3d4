#include "io/results/frames.h"

#include "contact/self/laps.h"
#include "contact/self/self_report.h"
#include "geometry/base/box.h"
#include "geometry/base/error.h"
#include "io/case/suggestion.h"
#include "io/results/wear_frame.h"
#include "mechanics/elements/elements.h"
#include "mechanics/elements/mesh_check.h"
#include "mechanics/mesh/mesh_edges.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

namespace billet::io {

namespace {

using mechanics::Index;

/// For each local node of an element kind, the integration points whose mean it shows: the closest,
/// in the middle of an edge of a simplex those towards both its corners.
std::vector<std::vector<int>> points_of_nodes(mechanics::ElementKind kind) {
  if (mechanics::is_simplex(kind) && mechanics::is_quadratic(kind)) {
    std::vector<std::vector<int>> points;
    points.reserve(idx(mechanics::corners_per_element(kind)) +
                   mechanics::element_edges(kind).size());
    for (int corner = 0; corner < mechanics::corners_per_element(kind); ++corner)
      points.push_back({corner});
    for (const auto& [a, b] : mechanics::element_edges(kind))
      points.push_back({a, b});
    return points;
  }
  return mechanics::visit_element(kind, [](auto element) {
    using Element = decltype(element);
    std::vector<std::vector<int>> nearest;
    for (const auto& node : Element::Shape::corners) {
      int best = 0;
      double closest = std::numeric_limits<double>::infinity();
      for (int g = 0; g < Element::Rule::points; ++g) {
        const auto xi = Element::Rule::point(g);
        double distance = 0.0;
        for (std::size_t d = 0; d < xi.size(); ++d)
          distance += (xi[d] - node[d]) * (xi[d] - node[d]);
        if (distance < closest) {
          closest = distance;
          best = g;
        }
      }
      nearest.push_back({best});
    }
    return nearest;
  });
}

/// Means at the nodes of a quantity with `components` values at each integration point.
std::vector<double>
to_nodes(const process::Run& run, int components, std::span<const double> at_points) {
  const mechanics::Mesh& mesh = run.mesh();
  const std::vector<std::vector<int>> nearest = points_of_nodes(mesh.kind);
  std::vector<double> sum(mesh.points.size() * idx(components), 0.0);
  std::vector<double> count(mesh.points.size(), 0.0);
  for (Index e = 0; e < mesh.n_elements(); ++e)
    for (std::size_t a = 0; a < nearest.size(); ++a) {
      const std::size_t node = idx(mesh.cell(e)[a]);
      count[node] += 1.0;
      for (const int g : nearest[a]) {
        const std::size_t point = idx(e * run.model.bulk->points() + g);
        for (std::size_t c = 0; c < idx(components); ++c)
          sum[node * idx(components) + c] +=
              at_points[point * idx(components) + c] / static_cast<double>(nearest[a].size());
      }
    }
  for (std::size_t k = 0; k < sum.size(); ++k)
    sum[k] /= std::max(count[k / idx(components)], 1.0);
  return sum;
}

double von_mises(const Mat3& sigma) {
  const Mat3 s = sigma - sigma.trace() / 3.0 * Mat3::Identity();
  return std::sqrt(1.5 * s.squaredNorm());
}

std::vector<double> three_components(std::span<const double> v, int dimension) {
  std::vector<double> out;
  for (const Vec3& p : points_of(v, dimension))
    out.insert(out.end(), p.data(), p.data() + 3);
  return out;
}

/// Puts the mean stress at the points of simplices to its mean over their element: within one it
/// alternates where plastic flow is held on many sides (docs/decisions/0008-simplex-elements.md).
void level_mean_stress(const process::Run& run, std::vector<Mat3>& stresses) {
  if (!mechanics::is_simplex(run.mesh().kind))
    return;
  const auto n = idx(run.model.bulk->points());
  for (std::size_t first = 0; first < stresses.size(); first += n) {
    double sum = 0.0;
    double volume = 0.0;
    for (std::size_t k = first; k < first + n; ++k) {
      sum += run.model.bulk->volumes()[k] * stresses[k].trace() / 3.0;
      volume += run.model.bulk->volumes()[k];
    }
    for (std::size_t k = first; k < first + n; ++k)
      stresses[k].diagonal().array() += sum / volume - stresses[k].trace() / 3.0;
  }
}

void add_stress(const process::Run& run, const FrameSettings& s, WorkpieceFrame& frame) {
  std::vector<Mat3> stresses = run.model.bulk->stresses(run.positions());
  level_mean_stress(run, stresses);
  std::vector<double> mises;
  std::vector<double> tensor;
  std::vector<double> mean;
  for (const Mat3& sigma : stresses) {
    mises.push_back(von_mises(sigma));
    mean.push_back(sigma.trace() / 3.0);
    tensor.insert(tensor.end(),
                  {sigma(0, 0), sigma(1, 1), sigma(2, 2), sigma(0, 1), sigma(1, 2), sigma(0, 2)});
  }
  frame.point_fields.push_back({"von_mises", 1, to_nodes(run, 1, mises), s.units.stress});
  frame.point_fields.push_back({"mean_stress", 1, to_nodes(run, 1, mean), s.units.stress});
  frame.point_fields.push_back({"stress", 6, to_nodes(run, 6, tensor), s.units.stress});
}

/// What the points of the surface bear, on tools and on other faces of the part.
std::vector<contact::PointResult> surface_results(const process::Run& run) {
  contact::PointResult far;
  far.gap = std::numeric_limits<double>::infinity();
  std::vector<contact::PointResult> results(run.model.surface->n_points(), far);
  if (run.contact() != nullptr)
    results = contact::point_results(*run.contact());
  if (run.model.self_contact)
    contact::add_self_contact(run.model.self_contact->state(), results);
  return results;
}

/// Contact values at the nodes: means over the contact points of the faces around them.
void add_contact(const process::Run& run, const FrameSettings& s, WorkpieceFrame& frame) {
  if (!run.model.surface)
    return;
  const contact::ContactSurface& surface = *run.model.surface;
  const std::vector<contact::PointResult> results = surface_results(run);
  const std::size_t n = frame.points.size();
  std::vector<double> count(n, 0.0);
  std::vector<double> pressure(n, 0.0);
  std::vector<double> shear(3 * n, 0.0);
  std::vector<double> sliding(n, 0.0);
  std::vector<double> status(n, 0.0);
  const std::vector<double> worn =
      run.model.wear.get() != nullptr ? run.model.wear->workpiece_depth() : std::vector<double>{};
  std::vector<double> wear(worn.empty() ? 0 : n, 0.0);
  std::vector<double> in_laps;
  if (run.model.self_contact)
    in_laps = contact::lap_depths(surface, run.model.self_contact->state(), run.positions());
  std::vector<double> lap_depth(in_laps.empty() ? 0 : n, 0.0);
  for (std::size_t k = 0; k < results.size(); ++k) {
    const Index face = static_cast<Index>(k / idx(surface.points()));
    for (const Index node : surface.scatter().nodes(face)) {
      const std::size_t a = idx(node);
      count[a] += 1.0;
      pressure[a] += results[k].pressure;
      sliding[a] += results[k].sliding;
      if (!worn.empty())
        wear[a] += worn[k];
      status[a] = std::max(status[a], static_cast<double>(results[k].status));
      if (!in_laps.empty())
        lap_depth[a] = std::max(lap_depth[a], in_laps[k]);
      for (std::size_t d = 0; d < 3; ++d)
        shear[3 * a + d] += results[k].shear[static_cast<Index>(d)];
    }
  }
  for (std::size_t a = 0; a < n; ++a) {
    const double share = count[a] > 0.0 ? 1.0 / count[a] : 0.0;
    pressure[a] *= share;
    sliding[a] *= share;
    if (!wear.empty())
      wear[a] *= share;
    for (std::size_t d = 0; d < 3; ++d)
      shear[3 * a + d] *= share;
  }
  frame.point_fields.push_back({"contact_pressure", 1, std::move(pressure), s.units.stress});
  frame.point_fields.push_back({"friction_stress", 3, std::move(shear), s.units.stress});
  frame.point_fields.push_back({"sliding_distance", 1, std::move(sliding), s.units.length});
  frame.point_fields.push_back({"contact_status", 1, std::move(status), "0 open 1 stick 2 slip"});
  if (!lap_depth.empty())
    frame.point_fields.push_back({"lap_depth", 1, std::move(lap_depth), s.units.length});
  if (!wear.empty())
    frame.point_fields.push_back({"wear_depth", 1, std::move(wear), s.units.length});
}

Notes notes_of(const FrameSettings& settings) {
  return {{"configuration", "current coordinates"},
          {"analysis", settings.analysis},
          {"title", settings.title},
          {"unit_system", settings.units.name}};
}

/// The planes of symmetry: "x = 0, y = 2.5"; empty: there are none.
std::string symmetry_of(const process::Run& run) {
  std::string text;
  for (const process::Wall& wall : run.state.walls) {
    const char axis = "xyz"[wall.component];
    const std::string plane = fmt::format("{} = {}", axis, wall.at);
    if (text.find(plane) == std::string::npos)
      text += (text.empty() ? "" : ", ") + plane;
  }
  return text;
}

/// Gives a surface the points of its sides and polygons alone, numbered anew.
void keep_points_in_use(std::span<const Vec3> points, SurfaceFrame& frame) {
  std::vector<Index> number(points.size(), -1);
  for (const auto* cells : {&frame.lines, &frame.polygons})
    for (const std::vector<Index>& cell : *cells)
      for (const Index node : cell)
        number[idx(node)] = 0;
  for (std::size_t a = 0; a < points.size(); ++a)
    if (number[a] == 0) {
      number[a] = static_cast<Index>(frame.points.size());
      frame.points.push_back(points[a]);
    }
  for (auto* cells : {&frame.lines, &frame.polygons})
    for (std::vector<Index>& cell : *cells)
      for (Index& node : cell)
        node = number[idx(node)];
}

} // namespace

const std::vector<std::string>& known_fields() {
  static const std::vector<std::string> names{
      "displacement",    "velocity",         "plastic_strain", "plastic_strain_rate",
      "temperature",     "von_mises",        "stress",         "contact_pressure",
      "friction_stress", "sliding_distance", "contact_status", "gap",
      "lap_depth",       "element_quality",  "wear_depth",     "wear_depth_extrapolated",
      "mean_stress"};
  return names;
}

void require_known_fields(const OutputSettings& output, const std::string& place) {
  const auto* wanted = std::get_if<std::vector<std::string>>(&output.fields);
  if (wanted == nullptr)
    return;
  std::vector<Complaint> complaints;
  for (const std::string& name : *wanted)
    if (std::find(known_fields().begin(), known_fields().end(), name) == known_fields().end())
      complaints.push_back({place, "output.fields: '" + name + "' is no field of the results",
                            suggestion(name, known_fields())});
  if (!complaints.empty())
    throw Error(Fault::case_file, std::move(complaints));
}

void select_fields(std::vector<Field>& fields, const OutputSettings& output) {
  const auto* wanted = std::get_if<std::vector<std::string>>(&output.fields);
  const bool all = wanted == nullptr && std::get<FieldSet>(output.fields) == FieldSet::all;
  std::erase_if(fields, [&](const Field& field) {
    if (wanted != nullptr)
      return std::find(wanted->begin(), wanted->end(), field.name) == wanted->end();
    return !all && field.name == known_fields().back();
  });
}

std::vector<Vec3> points_of(std::span<const double> x, int dimension) {
  std::vector<Vec3> points(x.size() / idx(dimension), Vec3::Zero());
  for (std::size_t i = 0; i < x.size(); ++i)
    points[i / idx(dimension)][static_cast<Index>(i % idx(dimension))] = x[i];
  return points;
}

WorkpieceFrame workpiece_frame(const process::Run& run,
                               std::span<const Vec3> points,
                               const FrameSettings& settings) {
  const mechanics::Mesh& mesh = run.mesh();
  WorkpieceFrame frame;
  frame.time = run.state.time;
  frame.kind = mesh.kind;
  frame.points = points;
  frame.cells = mesh.cells;
  frame.notes = notes_of(settings);
  if (const std::string planes = symmetry_of(run); !planes.empty())
    frame.notes.emplace_back("symmetry", planes);
  const std::vector<Vec3> origins = points_of(run.state.origins, mesh.dimension());
  std::vector<double> displacement;
  for (std::size_t a = 0; a < points.size(); ++a) {
    const Vec3 u = points[a] - origins[a];
    displacement.insert(displacement.end(), u.data(), u.data() + 3);
  }
  frame.point_fields.push_back({"displacement", 3, std::move(displacement), settings.units.length});
  frame.point_fields.push_back({"velocity", 3,
                                three_components(run.state.velocity, mesh.dimension()),
                                settings.units.length + "/" + settings.units.time});
  std::vector<double> strain;
  for (const auto& state : run.model.bulk->states())
    strain.push_back(state.plastic_strain);
  frame.point_fields.push_back({"plastic_strain", 1, to_nodes(run, 1, strain), "1"});
  frame.point_fields.push_back({"plastic_strain_rate", 1, to_nodes(run, 1, run.state.plastic_rate),
                                "1/" + settings.units.time});
  if (!run.model.bulk->temperatures().empty())
    frame.point_fields.push_back({"temperature", 1,
                                  to_nodes(run, 1, run.model.bulk->temperatures()),
                                  settings.units.temperature});
  add_stress(run, settings, frame);
  add_contact(run, settings, frame);
  frame.cell_fields.push_back(
      {"element_quality", 1, mechanics::element_qualities(mesh, points), "1"});
  return frame;
}

SurfaceFrame contact_frame(const process::Run& run,
                           std::span<const Vec3> points,
                           const FrameSettings& settings) {
  SurfaceFrame frame;
  frame.time = run.state.time;
  frame.notes = notes_of(settings);
  const contact::ContactSurface& surface = *run.model.surface;
  const std::vector<contact::PointResult> results = surface_results(run);
  const std::size_t n = idx(surface.points());
  std::vector<double> pressure;
  std::vector<double> shear;
  std::vector<double> gap;
  std::vector<double> status;
  for (Index f = 0; f < surface.n_faces(); ++f) {
    add_face(frame, surface.scatter().nodes(f), run.mesh().dimension());
    contact::PointResult mean;
    mean.gap = std::numeric_limits<double>::infinity();
    for (std::size_t k = idx(f) * n; k < (idx(f) + 1) * n; ++k) {
      mean.pressure += results[k].pressure / static_cast<double>(n);
      mean.shear += results[k].shear / static_cast<double>(n);
      mean.gap = std::min(mean.gap, results[k].gap);
      mean.status = std::max(mean.status, results[k].status);
    }
    pressure.push_back(mean.pressure);
    shear.insert(shear.end(), mean.shear.data(), mean.shear.data() + 3);
    gap.push_back(std::isfinite(mean.gap) ? mean.gap : std::numeric_limits<double>::quiet_NaN());
    status.push_back(static_cast<double>(mean.status));
  }
  frame.cell_fields.push_back({"contact_pressure", 1, std::move(pressure), settings.units.stress});
  frame.cell_fields.push_back({"friction_stress", 3, std::move(shear), settings.units.stress});
  frame.cell_fields.push_back({"gap", 1, std::move(gap), settings.units.length});
  frame.cell_fields.push_back({"contact_status", 1, std::move(status), "0 open 1 stick 2 slip"});
  keep_points_in_use(points, frame);
  return frame;
}

SurfaceFrame tool_frame(const process::Run& run,
                        std::size_t tool,
                        std::span<const Vec3> points,
                        const FrameSettings& settings) {
  const contact::Tool& rigid = run.tools()[tool];
  const geometry::Pose pose = rigid.motion.pose(run.state.time, run.driven(tool));
  const Box box = box_of(points);
  constexpr double margin_share = 0.15;
  const Vec3 margin = Vec3::Constant(margin_share * box.size());
  Box window;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 p;
    for (int d = 0; d < 3; ++d)
      p[d] = ((corner >> d) & 1) != 0 ? box.high[d] + margin[d] : box.low[d] - margin[d];
    window.add(pose.to_tool(p));
  }
  const bool planar = run.mesh().dimension() == 2;
  SurfaceFrame frame;
  frame.time = run.state.time;
  frame.notes = notes_of(settings);
  if (run.model.wear.get() != nullptr && run.model.wear->map(tool)) {
    add_wear(*run.model.wear->map(tool), rigid, window, settings.units.length, frame);
    for (Vec3& p : frame.points)
      p = pose.to_space(p);
    return frame;
  }
  const geometry::DisplayMesh shape = rigid.surface->display(window, planar);
  for (const Vec3& p : shape.points)
    frame.points.push_back(pose.to_space(p));
  for (const auto& line : shape.lines)
    frame.lines.push_back({line[0], line[1]});
  for (const auto& triangle : shape.triangles)
    frame.polygons.push_back({triangle[0], triangle[1], triangle[2]});
  return frame;
}

} // namespace billet::io
