#include "geometry/triangles/box_pairs.h"

#include <CGAL/Bbox_3.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <vector>

namespace billet::geometry {

namespace {

using NumberedBox = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::int32_t>;

// CGAL's sweep can only be left by an exception; it never leaves this file.
struct Ended {};

std::vector<NumberedBox> numbered(std::span<const Box> boxes) {
  std::vector<NumberedBox> list;
  list.reserve(boxes.size());
  for (const Box& b : boxes)
    list.emplace_back(
        CGAL::Bbox_3(b.low.x(), b.low.y(), b.low.z(), b.high.x(), b.high.y(), b.high.z()),
        static_cast<std::int32_t>(list.size()));
  return list;
}

} // namespace

bool visit_box_pairs(std::span<const Box> boxes, const BoxPairVisit& visit) {
  std::vector<NumberedBox> list = numbered(boxes);
  try {
    CGAL::box_self_intersection_d(
        list.begin(), list.end(), [&](const NumberedBox& a, const NumberedBox& b) {
          if (!visit(std::min(a.info(), b.info()), std::max(a.info(), b.info())))
            throw Ended{};
        });
  } catch (const Ended&) {
    return false;
  }
  return true;
}

bool visit_box_pairs(std::span<const Box> first,
                     std::span<const Box> second,
                     const BoxPairVisit& visit) {
  std::vector<NumberedBox> a = numbered(first), b = numbered(second);
  try {
    CGAL::box_intersection_d(a.begin(), a.end(), b.begin(), b.end(),
                             [&](const NumberedBox& i, const NumberedBox& j) {
                               if (!visit(i.info(), j.info()))
                                 throw Ended{};
                             });
  } catch (const Ended&) {
    return false;
  }
  return true;
}

} // namespace billet::geometry
