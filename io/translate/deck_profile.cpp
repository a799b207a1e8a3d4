#include "io/translate/deck_profile.h"

#include <cmath>

namespace billet::io {

DeckProfile profile_of(const DeckSurface& surface, std::vector<std::string>& remarks) {
  DeckProfile profile;
  Vec3 last = Vec3::Zero();
  for (const DeckCurve& curve : surface.curves) {
    const auto number = [&](std::size_t i) {
      return i < curve.numbers.size() ? curve.numbers[i] : 0.0;
    };
    const Vec3 point(number(0), number(1), 0.0);
    if (curve.word == "START") {
      profile.start = point;
    } else if (curve.word == "CIRCL") {
      const Vec3 centre(number(2), number(3), 0.0);
      const Vec3 a = last - centre, b = point - centre;
      const double turn = a.x() * b.y() - a.y() * b.x();
      profile.pieces.push_back({point, std::copysign(0.5 * (a.norm() + b.norm()), turn), centre});
    } else if (curve.word == "PARAB") {
      const Vec3 end(number(2), number(3), 0.0);
      constexpr int pieces = 24;
      for (int k = 1; k <= pieces; ++k) {
        const double s = static_cast<double>(k) / pieces;
        const Vec3 control = 2.0 * point - 0.5 * (last + end);
        profile.pieces.push_back(
            {(1.0 - s) * (1.0 - s) * last + 2.0 * s * (1.0 - s) * control + s * s * end});
      }
      remarks.push_back("a parabola is drawn as 24 lines");
      last = end;
      continue;
    } else {
      profile.pieces.push_back({point});
    }
    last = point;
  }
  return profile;
}

Vec3 frame_point(const DeckSurface& surface, std::size_t i, const Vec3& otherwise) {
  return surface.frame.size() >= 3 * i + 3
             ? Vec3(surface.frame[3 * i], surface.frame[3 * i + 1], surface.frame[3 * i + 2])
             : otherwise;
}

} // namespace billet::io
