// Functions with their first and second derivatives, by the rules of Taylor's series.
//
// Internal to geometry/: enough of forward differentiation for the blends of curved triangles.

#pragma once

#include "geometry/base/vector.h"

namespace billet::geometry {

/// A scalar or vector function of one parameter.
template <class Value> struct Taylor1 {
  Value f;  ///< value
  Value d;  ///< first derivative
  Value dd; ///< second derivative
};

template <class Value>
[[nodiscard]] Taylor1<Value> operator*(const Taylor1<double>& s, const Taylor1<Value>& v) {
  return {s.f * v.f, s.d * v.f + s.f * v.d, s.dd * v.f + 2.0 * s.d * v.d + s.f * v.dd};
}

[[nodiscard]] inline Taylor1<double> dot(const Taylor1<Vec3>& a, const Taylor1<Vec3>& b) {
  return {a.f.dot(b.f), a.d.dot(b.f) + a.f.dot(b.d),
          a.dd.dot(b.f) + 2.0 * a.d.dot(b.d) + a.f.dot(b.dd)};
}

[[nodiscard]] inline Taylor1<double> operator/(const Taylor1<double>& a, const Taylor1<double>& b) {
  const double f = a.f / b.f, d = (a.d - f * b.d) / b.f;
  return {f, d, (a.dd - 2.0 * d * b.d - f * b.dd) / b.f};
}

[[nodiscard]] inline Taylor1<Vec3> operator-(const Taylor1<Vec3>& a, const Taylor1<Vec3>& b) {
  return {a.f - b.f, a.d - b.d, a.dd - b.dd};
}

/// A scalar function of two parameters (v, w).
struct Taylor2 {
  double f, v, w, vv, vw, ww; ///< value and derivatives
};

[[nodiscard]] inline Taylor2 operator*(const Taylor2& a, const Taylor2& b) {
  return {a.f * b.f,
          a.v * b.f + a.f * b.v,
          a.w * b.f + a.f * b.w,
          a.vv * b.f + 2.0 * a.v * b.v + a.f * b.vv,
          a.vw * b.f + a.v * b.w + a.w * b.v + a.f * b.vw,
          a.ww * b.f + 2.0 * a.w * b.w + a.f * b.ww};
}

[[nodiscard]] inline Taylor2 operator+(const Taylor2& a, const Taylor2& b) {
  return {a.f + b.f, a.v + b.v, a.w + b.w, a.vv + b.vv, a.vw + b.vw, a.ww + b.ww};
}

[[nodiscard]] inline Taylor2 operator/(const Taylor2& a, const Taylor2& b) {
  Taylor2 q{a.f / b.f, 0.0, 0.0, 0.0, 0.0, 0.0};
  q.v = (a.v - q.f * b.v) / b.f;
  q.w = (a.w - q.f * b.w) / b.f;
  q.vv = (a.vv - 2.0 * q.v * b.v - q.f * b.vv) / b.f;
  q.vw = (a.vw - q.v * b.w - q.w * b.v - q.f * b.vw) / b.f;
  q.ww = (a.ww - 2.0 * q.w * b.w - q.f * b.ww) / b.f;
  return q;
}

} // namespace billet::geometry
