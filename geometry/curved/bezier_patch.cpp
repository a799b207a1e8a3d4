#include "geometry/curved/bezier_patch.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace billet::geometry {

namespace {

constexpr std::size_t row_size = 3; // points along a direction

/// Calls `visit(first, stride)` for each row of three points along a direction.
template <class Visit>
void for_each_row(std::size_t size, std::size_t direction, const Visit& visit) {
  const std::size_t stride = direction == 0 ? 1 : row_size;
  for (std::size_t row = 0; row < size / row_size; ++row)
    visit(direction == 0 ? row * row_size : row, stride);
}

/// Of a triangle's control points, in rows of 3, 2 and 1: corners, and the one of the side from
/// each corner to the next.
constexpr std::array<std::size_t, 3> corner_at{0, 2, 5};
constexpr std::array<std::size_t, 3> side_at{1, 4, 3};
constexpr std::size_t triangle_size = 6;

} // namespace

bool BezierPatch::triangle() const { return size_ == triangle_size; }

BezierPatch::BezierPatch(std::span<const Vec3> at) : size_(at.size()) {
  assert(size_ == row_size || triangle() || size_ == row_size * row_size);
  std::copy(at.begin(), at.end(), control_.begin());
  if (triangle()) {
    for (std::size_t i = 0; i < 3; ++i)
      control_[side_at[i]] =
          2.0 * at[side_at[i]] - 0.5 * (at[corner_at[i]] + at[corner_at[(i + 1) % 3]]);
    return;
  }
  for (std::size_t direction = 0; direction < size_ / row_size && direction < 2; ++direction)
    for_each_row(size_, direction, [&](std::size_t first, std::size_t stride) {
      Vec3& middle = control_[first + stride];
      middle = 2.0 * middle - 0.5 * (control_[first] + control_[first + 2 * stride]);
    });
}

Vec3 BezierPatch::centre() const {
  if (triangle()) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < 3; ++i)
      sum += control_[corner_at[i]] + 2.0 * control_[side_at[i]];
    return sum / 9.0;
  }
  const auto along = [&](std::size_t first) {
    return Vec3(0.25 * (control_[first] + 2.0 * control_[first + 1] + control_[first + 2]));
  };
  return size_ == row_size ? along(0)
                           : Vec3(0.25 * (along(0) + 2.0 * along(row_size) + along(2 * row_size)));
}

double BezierPatch::farthest(const Vec3& from) const {
  double most2 = 0.0;
  for (const Vec3& point : control())
    most2 = std::max(most2, (point - from).squaredNorm());
  return std::sqrt(most2);
}

Vec3 BezierPatch::farthest_corner(const Vec3& from) const {
  // A triangle's last row is its last corner.
  const std::size_t last_row = triangle() ? size_ - 1 : size_ - row_size;
  std::size_t best = 0;
  for (const std::size_t corner : {row_size - 1, last_row, size_ - 1})
    if ((control_[corner] - from).squaredNorm() > (control_[best] - from).squaredNorm())
      best = corner;
  return control_[best];
}

double BezierPatch::length(std::size_t direction) const {
  double most = 0.0;
  for_each_row(size_, direction, [&](std::size_t first, std::size_t stride) {
    const Vec3& middle = control_[first + stride];
    most = std::max(most, (middle - control_[first]).norm() +
                              (control_[first + 2 * stride] - middle).norm());
  });
  return most;
}

/// By de Casteljau's steps at the middle of the longest side: with that side from a to b, c
/// opposite.
std::array<BezierPatch, 2> BezierPatch::triangle_halves() const {
  const auto length_of = [&](std::size_t i) {
    return (control_[side_at[i]] - control_[corner_at[i]]).norm() +
           (control_[corner_at[(i + 1) % 3]] - control_[side_at[i]]).norm();
  };
  std::size_t longest = 0;
  for (const std::size_t i : {std::size_t{1}, std::size_t{2}})
    longest = length_of(i) > length_of(longest) ? i : longest;
  const std::size_t a = longest, b = (longest + 1) % 3, c = (longest + 2) % 3;
  const Vec3 left = 0.5 * (control_[corner_at[a]] + control_[side_at[a]]);
  const Vec3 right = 0.5 * (control_[side_at[a]] + control_[corner_at[b]]);
  const Vec3 cut = 0.5 * (left + right);
  const Vec3 inside = 0.5 * (control_[side_at[b]] + control_[side_at[c]]);
  std::array<BezierPatch, 2> halves{*this, *this};
  halves[0].control_[side_at[a]] = left;
  halves[0].control_[corner_at[b]] = cut;
  halves[0].control_[side_at[b]] = inside;
  halves[1].control_[side_at[a]] = right;
  halves[1].control_[corner_at[a]] = cut;
  halves[1].control_[side_at[c]] = inside;
  return halves;
}

std::array<BezierPatch, 2> BezierPatch::halves() const {
  if (triangle())
    return triangle_halves();
  const std::size_t direction = size_ > row_size && length(1) > length(0) ? 1 : 0;
  std::array<BezierPatch, 2> halves{*this, *this};
  for_each_row(size_, direction, [&](std::size_t first, std::size_t stride) {
    const std::size_t middle = first + stride, last = middle + stride;
    const Vec3 left = 0.5 * (control_[first] + control_[middle]);
    const Vec3 right = 0.5 * (control_[middle] + control_[last]);
    const Vec3 cut = 0.5 * (left + right);
    halves[0].control_[middle] = left;
    halves[0].control_[last] = cut;
    halves[1].control_[first] = cut;
    halves[1].control_[middle] = right;
  });
  return halves;
}

BezierPatch BezierPatch::in_tool(const Pose& pose) const {
  BezierPatch moved = *this;
  for (std::size_t i = 0; i < size_; ++i)
    moved.control_[i] = pose.to_tool(control_[i]);
  return moved;
}

} // namespace billet::geometry
