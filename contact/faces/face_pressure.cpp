#include "contact/faces/face_pressure.h"

namespace billet::contact {

namespace {

using Active = Eigen::Array<bool, Eigen::Dynamic, 1>;

/// sum of w over active points.
double sum_of(const PointValues& w, const Active& active) {
  return active.select(w.array(), 0.0).sum();
}

} // namespace

FacePressure face_pressure(const FaceCompliance& face, const PointValues& gaps, bool pulls) {
  // With c = K_d / K, p_k = max(0, (1 - c) m + q_k) and m the mean of p.
  const double c = face.deviation / face.mean;
  const PointValues q =
      (c * face.multiplier + (face.rise - face.deviation * gaps).array()).matrix();
  const PointValues wq = face.weights.cwiseProduct(q);
  const auto mean_of = [&](const Active& active) {
    return sum_of(wq, active) / (1.0 - (1.0 - c) * sum_of(face.weights, active));
  };
  const auto pressed_at = [&](double m) -> Active { return ((1.0 - c) * m + q.array()) > 0.0; };
  Active active = Active::Constant(gaps.size(), true);
  double mean = mean_of(active);
  // Newton's method on m - sum w max(0, (1 - c) m + q), which rises and is concave: from its second
  // step on m only grows, and with it the set of points that press.
  for (Eigen::Index step = 0; !pulls && step <= gaps.size(); ++step) {
    active = pressed_at(mean);
    const double next = mean_of(active);
    if (next == mean)
      break;
    mean = next;
  }
  FacePressure out;
  out.pressure = active.select((1.0 - c) * mean + q.array(), 0.0).matrix();
  const double share = sum_of(face.weights, active);
  const PointValues dm =
      -face.deviation / (1.0 - (1.0 - c) * share) * active.select(face.weights.array(), 0.0);
  const PointValues pressing = active.cast<double>().matrix();
  out.d_gap = (1.0 - c) * pressing * dm.transpose();
  out.d_gap.diagonal() -= face.deviation * pressing;
  return out;
}

} // namespace billet::contact
