#include "app/report/svg_chart.h"

#include "app/render/axis.h"
#include "app/report/html.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

namespace billet::report {

namespace {

// In pixels of the picture.
constexpr double picture_width = 560.0, picture_height = 300.0;
constexpr double left = 72.0, right = 12.0, top = 12.0, bottom = 44.0;

constexpr std::array<const char*, 6> colours{"var(--c1)", "var(--c2)", "var(--c3)",
                                             "var(--c4)", "var(--c5)", "var(--c6)"};

struct Axes {
  render::Axis x, y;

  [[nodiscard]] double to_x(double value) const {
    return left + x.share(value) * (picture_width - left - right);
  }
  [[nodiscard]] double to_y(double value) const {
    return picture_height - bottom - y.share(value) * (picture_height - top - bottom);
  }
};

Axes axes_of(const NamedChart& named) {
  constexpr int most_steps = 6;
  Vec2 least = Vec2::Constant(std::numeric_limits<double>::infinity());
  Vec2 most = -least;
  for (const render::Curve& curve : named.chart.curves)
    for (const Vec2& value : curve.values) {
      least = least.cwiseMin(value);
      most = most.cwiseMax(value);
    }
  const auto upwards = named.logarithmic ? render::logarithmic_axis : render::axis_through_zero;
  return {render::axis_through_zero(least[0], most[0], most_steps),
          upwards(least[1], most[1], most_steps)};
}

std::string grid(const Axes& axes) {
  std::string svg;
  for (const double tick : axes.x.ticks())
    svg += fmt::format("<line class=\"grid\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\"/>"
                       "<text x=\"{0:.1f}\" y=\"{3}\" text-anchor=\"middle\">{4}</text>\n",
                       axes.to_x(tick), top, picture_height - bottom,
                       picture_height - bottom + 16.0, axes.x.label(tick));
  for (const double tick : axes.y.ticks()) {
    const double y = axes.to_y(tick);
    svg += fmt::format("<line class=\"grid\" x1=\"{1}\" x2=\"{2}\" y1=\"{0:.1f}\" y2=\"{0:.1f}\"/>"
                       "<text x=\"{3}\" y=\"{4:.1f}\" text-anchor=\"end\">{5}</text>\n",
                       y, left, picture_width - right, left - 6.0, y + 4.0, axes.y.label(tick));
  }
  return svg;
}

std::string line(const render::Curve& curve, const Axes& axes, const char* colour) {
  constexpr std::size_t most_points = 400;
  std::string points;
  for (const Vec2& value : thinned(curve.values, most_points))
    points += fmt::format("{:.1f},{:.1f} ", axes.to_x(value[0]), axes.to_y(value[1]));
  return fmt::format("<polyline points=\"{}\" style=\"stroke:{}\"/>\n", points, colour);
}

std::string key(const std::vector<render::Curve>& curves) {
  std::string html = "<figcaption>";
  for (std::size_t i = 0; i < curves.size(); ++i)
    html += fmt::format("<span class=\"key\"><i style=\"background:{}\"></i>{}</span>",
                        colours.at(i % colours.size()), escaped(curves[i].label));
  return html + "</figcaption>";
}

} // namespace

std::string svg_of(const NamedChart& named) {
  const Axes axes = axes_of(named);
  std::string svg = fmt::format("<svg viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
                                "role=\"img\" aria-label=\"{2}\">\n",
                                picture_width, picture_height, escaped(named.chart.title));
  svg += grid(axes);
  for (std::size_t i = 0; i < named.chart.curves.size(); ++i)
    svg += line(named.chart.curves[i], axes, colours.at(i % colours.size()));
  svg += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n",
                     (left + picture_width - right) / 2.0, picture_height - 8.0,
                     escaped(named.chart.x_label));
  svg += fmt::format(
      "<text transform=\"translate(14 {}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
      (top + picture_height - bottom) / 2.0, escaped(named.chart.y_label));
  return svg + "</svg>\n" + key(named.chart.curves);
}

} // namespace billet::report
