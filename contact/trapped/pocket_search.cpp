#include "contact/trapped/pocket_search.h"

#include "contact/term/contact_report.h"
#include "contact/trapped/pocket_volume.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>

namespace billet::contact {

namespace {

Vec3 place_of(std::span<const double> x, Index node) {
  return {x[idx(2 * node)], x[idx(2 * node + 1)], 0.0};
}

/// The free faces between two places where tools touch. The faces there belong to it if they gape
/// towards it.
struct Stretch {
  std::vector<Index> faces;
  Index before = -1; ///< face before it that a tool touches; -1: the surface begins there
  Index after = -1;  ///< face after it that a tool touches; -1: the surface ends there
};

class Surface {
public:
  Surface(const ContactView& contact,
          std::span<const SymmetryLine> lines,
          std::span<const double> x,
          double time)
      : contact_(contact), surface_(*contact.model.surface), lines_(lines), x_(x), time_(time) {
    find_neighbours();
    find_touching();
    for (Index f = 0; f < surface_.n_faces(); ++f)
      for (const Index node : surface_.scatter().nodes(f))
        window_.add(place_of(x, node));
  }

  [[nodiscard]] std::vector<PocketPlace> pockets() const {
    std::vector<PocketPlace> found;
    for (Index f = 0; f < surface_.n_faces(); ++f)
      if (touching_[idx(f)].empty() && (before(f) < 0 || !touching_[idx(before(f))].empty()))
        if (std::optional<PocketPlace> pocket = pocket_of(stretch_from(f)))
          found.push_back(std::move(*pocket));
    return found;
  }

private:
  void find_neighbours() {
    std::unordered_map<Index, Index> by_first;
    for (Index f = 0; f < surface_.n_faces(); ++f)
      by_first[surface_.scatter().nodes(f)[0]] = f;
    before_.assign(idx(surface_.n_faces()), -1);
    after_ = before_;
    for (Index f = 0; f < surface_.n_faces(); ++f)
      if (const auto next = by_first.find(surface_.scatter().nodes(f)[1]);
          next != by_first.end() && next->second != f) {
        after_[idx(f)] = next->second;
        before_[idx(next->second)] = f;
      }
  }
  void find_touching() {
    touching_.resize(idx(surface_.n_faces()));
    closed_.assign(surface_.n_points(), 0);
    for (std::size_t t = 0; t < contact_.model.tools.size(); ++t)
      for (std::size_t k = 0; k < surface_.n_points(); ++k)
        if (closed_on(contact_, t, k)) {
          auto& tools = touching_[idx(contact_.model.face_of(k))];
          if (tools.empty() || tools.back() != t)
            tools.push_back(t);
          closed_[k] = 1;
        }
  }

  /// Whether a face that a tool touches is open at its beginning, or at its end.
  [[nodiscard]] bool gapes(Index face, bool at_end) const {
    const std::size_t first = idx(face * surface_.points());
    return closed_[at_end ? first + idx(surface_.points() - 1) : first] == 0;
  }

  [[nodiscard]] Index before(Index face) const { return before_[idx(face)]; }

  [[nodiscard]] Stretch stretch_from(Index first) const {
    Stretch stretch;
    stretch.before = before(first);
    if (stretch.before >= 0 && gapes(stretch.before, true))
      stretch.faces.push_back(stretch.before);
    Index face = first;
    while (face >= 0 && touching_[idx(face)].empty()) {
      stretch.faces.push_back(face);
      face = after_[idx(face)];
    }
    stretch.after = face;
    if (face >= 0 && gapes(face, false))
      stretch.faces.push_back(face);
    return stretch;
  }

  /// The line of symmetry that a place lies on.
  [[nodiscard]] const SymmetryLine* line_at(const Vec3& place) const {
    constexpr double near = 1e-6; // of the part
    for (const SymmetryLine& line : lines_)
      if (std::abs(place[line.component] - line.at) <= near * window_.size())
        return &line;
    return nullptr;
  }

  /// The pocket that a stretch makes with the tool that leaves the least between them.
  [[nodiscard]] std::optional<PocketPlace> pocket_of(const Stretch& stretch) const {
    std::optional<PocketPlace> best;
    const Index touched = stretch.before >= 0 ? stretch.before : stretch.after;
    if (touched < 0)
      return best;
    for (const std::size_t tool : touching_[idx(touched)]) {
      const auto touches = [&](Index face) {
        const auto& tools = touching_[idx(face)];
        return face < 0 || std::find(tools.begin(), tools.end(), tool) != tools.end();
      };
      if ((stretch.before >= 0 && !touches(stretch.before)) ||
          (stretch.after >= 0 && !touches(stretch.after)))
        continue;
      const std::optional<PocketPlace> pocket = pocket_with(stretch, tool);
      if (pocket && (!best || pocket->volume < best->volume))
        best = pocket;
    }
    return best;
  }

  [[nodiscard]] std::optional<PocketPlace> pocket_with(const Stretch& stretch,
                                                       std::size_t tool) const {
    const Vec3 first = place_of(x_, surface_.scatter().nodes(stretch.faces.front())[0]),
               last = place_of(x_, surface_.scatter().nodes(stretch.faces.back())[1]);
    const SymmetryLine* const first_line = stretch.before < 0 ? line_at(first) : nullptr;
    const SymmetryLine* const last_line = stretch.after < 0 ? line_at(last) : nullptr;
    if ((stretch.before < 0 && first_line == nullptr) ||
        (stretch.after < 0 && last_line == nullptr))
      return std::nullopt; // the surface ends where nothing closes it
    const geometry::Pose pose = contact_.model.pose(tool, time_, x_);
    const ToolLine line(*contact_.model.tools[tool].surface, pose, window_);
    if (line.empty())
      return std::nullopt;
    std::optional<double> least;
    for (const bool forward : {true, false}) {
      // From the end of the chain back to its beginning.
      std::optional<std::vector<Vec3>> way;
      if (last_line != nullptr) {
        way = line.way(line.nearest(first), *last_line, forward);
        if (way)
          std::reverse(way->begin(), way->end());
      } else if (first_line != nullptr) {
        way = line.way(line.nearest(last), *first_line, forward);
      } else {
        way = line.way(line.nearest(last), line.nearest(first), forward);
      }
      if (!way)
        continue;
      const double volume = volume_between(stretch, *way, first, last);
      if (volume > 0.0 && (!least || volume < *least))
        least = volume;
    }
    return least ? std::optional(place(stretch, tool, *least)) : std::nullopt;
  }

  /// On the right of the chain, back along the tool.
  [[nodiscard]] double volume_between(const Stretch& stretch,
                                      const std::vector<Vec3>& way,
                                      const Vec3& first,
                                      const Vec3& last) const {
    double moment = chain_of(surface_, stretch.faces, x_, {}).moment;
    Vec3 from = last;
    for (const Vec3& point : way) {
      moment += line_moment(surface_.analysis(), from, point);
      from = point;
    }
    return -moment - line_moment(surface_.analysis(), from, first);
  }

  [[nodiscard]] PocketPlace place(const Stretch& stretch, std::size_t tool, double volume) const {
    const Chain chain = chain_of(surface_, stretch.faces, x_, {});
    double depth = 0.0;
    for (const Index face : stretch.faces)
      depth += surface_.depth(face) / static_cast<double>(stretch.faces.size());
    return {stretch.faces,
            tool,
            volume,
            chain.area,
            chain.length,
            chain.centre,
            PocketPlace::least_depth * depth * chain.area};
  }

  const ContactView& contact_;
  const ContactSurface& surface_;
  std::span<const SymmetryLine> lines_;
  std::span<const double> x_;
  double time_;
  Box window_;
  std::vector<Index> before_, after_;
  std::vector<std::vector<std::size_t>> touching_; ///< tools, of the faces
  std::vector<char> closed_;                       ///< on any tool, of the points
};

} // namespace

std::vector<PocketPlace> find_pockets(const ContactView& contact,
                                      std::span<const SymmetryLine> lines,
                                      std::span<const double> x,
                                      double time) {
  return Surface(contact, lines, x, time).pockets();
}

} // namespace billet::contact
