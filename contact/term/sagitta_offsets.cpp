#include "contact/term/sagitta_offsets.h"

#include "contact/surface/linear_faces.h"

#include <algorithm>
#include <span>
#include <vector>

namespace billet::contact {

namespace {

/// Faces that touch a tool and two rings of faces around: what touches next needs the means of its
/// own nodes as well.
std::vector<Index> faces_around_contact(const ContactModel& model,
                                        const std::vector<PointHistory>& history) {
  const ContactSurface& surface = *model.surface;
  const auto points = static_cast<std::ptrdiff_t>(surface.points());
  const auto touches = [&](Index face) {
    const auto first = history.begin() + face * points;
    return std::any_of(first, first + points,
                       [](const PointHistory& point) { return point.closed(); });
  };
  std::vector<char> near(idx(model.pattern->n_nodes()), 0);
  const auto is_near = [&](Index face) {
    const auto nodes = surface.scatter().nodes(face);
    return std::any_of(nodes.begin(), nodes.end(), [&](Index a) { return near[idx(a)] != 0; });
  };
  const auto all_that = [&](const auto& holds) {
    std::vector<Index> faces;
    for (Index f = 0; f < surface.n_faces(); ++f)
      if (holds(f))
        faces.push_back(f);
    return faces;
  };
  const auto mark = [&](const std::vector<Index>& faces) {
    for (const Index f : faces)
      for (const Index node : surface.scatter().nodes(f))
        near[idx(node)] = 1;
  };
  mark(all_that(touches));
  mark(all_that(is_near));
  return all_that(is_near);
}

/// Feet of the points of faces on a tool and around; of others, not found.
std::vector<geometry::Projection> feet_around_contact(const ContactModel& model,
                                                      const ToolContact& contact,
                                                      const geometry::RigidSurface& tool) {
  const auto points = idx(model.surface->points());
  std::vector<geometry::Projection> feet(contact.trial.foot.size());
  std::vector<std::size_t> missing;
  std::vector<Vec3> places;
  std::vector<geometry::Projection> found;
  for (const Index f : faces_around_contact(model, contact.committed.history))
    for (std::size_t k = idx(f) * points; k < (idx(f) + 1) * points; ++k) {
      feet[k] = contact.trial.foot[k];
      if (feet[k].found())
        continue;
      missing.push_back(k); // it is known to be open: nobody has asked
      places.push_back(contact.committed.history[k].position);
      found.emplace_back();
      found.back().patch = feet[k].patch;
    }
  tool.project(places, model.reach, found);
  for (std::size_t i = 0; i < missing.size(); ++i)
    feet[missing[i]] = found[i];
  return feet;
}

} // namespace

void set_sagitta_offsets(const ContactModel& model,
                         ToolContact& contact,
                         std::size_t tool,
                         const mechanics::Trial& trial) {
  const ContactSurface& surface = *model.surface;
  if (!surface.linear())
    return;
  std::vector<PointHistory>& points = contact.committed.history;
  std::vector<double> offset(points.size(), 0.0);
  if (contact.committed.touches)
    offset = sagitta_offsets(surface, trial.x.first(idx(model.pattern->n_dofs())),
                             model.pose(tool, trial.time, trial.x),
                             feet_around_contact(model, contact, *model.tools[tool].surface));
  for (std::size_t k = 0; k < offset.size(); ++k) {
    points[k].decayed += points[k].sagitta_offset - offset[k];
    points[k].sagitta_offset = offset[k];
  }
}

} // namespace billet::contact
