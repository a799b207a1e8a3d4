#include "app/render/chart.h"

#include "app/render/axis.h"
#include "app/render/canvas.h"
#include "app/render/curve.h"
#include "app/render/history_curves.h"
#include "app/render/load_stroke.h"
#include "geometry/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace billet::render {

namespace {

constexpr Colour black{0, 0, 0};
constexpr Colour grey{120, 120, 120};
constexpr Colour light{224, 224, 224};

/// Colours that the colour-blind can tell apart (Okabe and Ito).
const Colour& colour_of(std::size_t number) {
  static constexpr std::array<Colour, 7> colours{{{0, 114, 178},
                                                  {213, 94, 0},
                                                  {0, 158, 115},
                                                  {204, 121, 167},
                                                  {86, 180, 233},
                                                  {0, 0, 0},
                                                  {230, 159, 0}}};
  return colours[number % colours.size()];
}

std::array<Vec2, 2> range_of(const std::vector<Curve>& curves) {
  std::array<Vec2, 2> range{curves[0].values[0], curves[0].values[0]};
  for (const Curve& curve : curves)
    for (const Vec2& value : curve.values)
      range = {range[0].cwiseMin(value), range[1].cwiseMax(value)};
  return range;
}

/// The place of the curves on the paper, and the scale of what is drawn next to them.
struct Layout {
  Axis x, y;
  Vec2 low, high; ///< corners of the field [pixels]
  int font;       ///< [pixels]

  [[nodiscard]] Vec2 at(const Vec2& value) const {
    const Vec2 share(x.share(value.x()), y.share(value.y()));
    return low + share.cwiseProduct(high - low);
  }
};

Layout layout_of(const Chart& chart, const std::array<int, 2>& size) {
  constexpr int smallest = 8, largest = 32, lines = 46;
  Layout layout{};
  layout.font = std::clamp(std::min(size[0], size[1]) / lines, smallest, largest);
  const double font = layout.font;
  const std::array<Vec2, 2> range = range_of(chart.curves);
  const auto axis = [&](int way, int most_steps) {
    const auto make = chart.logarithmic.at(static_cast<std::size_t>(way)) ? logarithmic_axis
                      : chart.tight                                       ? axis_of
                                                                          : axis_through_zero;
    return make(range[0][way], range[1][way], most_steps);
  };
  layout.y = axis(1, std::clamp(size[1] / 90, 2, 12));
  layout.x = axis(0, std::clamp(size[0] / 100, 2, 12));
  double widest = 0.0;
  for (const double tick : layout.y.ticks())
    widest = std::max(widest, Canvas::text_length(layout.y.label(tick), layout.font));
  layout.low = {widest + 4.0 * font, 4.5 * font};
  layout.high = {size[0] - 3.0 * font, size[1] - 3.5 * font};
  return layout;
}

void draw_axes(Canvas& canvas, const Layout& on, const Chart& chart) {
  const double font = on.font;
  const auto straight = [&](const Vec2& a, const Vec2& b, double width, const Colour& colour) {
    // Middles of pixels: sharp.
    const auto snapped = [](const Vec2& p) {
      return Vec2(std::floor(p.x()) + 0.5, std::floor(p.y()) + 0.5);
    };
    canvas.line(std::array{snapped(a), snapped(b)}, width, colour);
  };
  const Vec2 down(0.0, -0.4 * font), left(-0.4 * font, 0.0);
  for (const double tick : on.x.ticks()) {
    const Vec2 foot(on.at({tick, on.y.low}));
    straight(foot, {foot.x(), on.high.y()}, 1.0, light);
    straight(foot, foot + down, 1.0, black);
    canvas.text(on.x.label(tick), foot + 1.5 * down,
                {.size = on.font, .along = Hold::middle, .across = Hold::high});
  }
  for (const double tick : on.y.ticks()) {
    const Vec2 foot(on.at({on.x.low, tick}));
    straight(foot, {on.high.x(), foot.y()}, 1.0, light);
    straight(foot, foot + left, 1.0, black);
    canvas.text(on.y.label(tick), foot + 1.7 * left,
                {.size = on.font, .along = Hold::high, .across = Hold::middle});
  }
  if (!on.y.logarithmic && on.y.low <= 0.0 && on.y.high >= 0.0)
    straight(on.at({on.x.low, 0.0}), on.at({on.x.high, 0.0}), 1.0, grey);
  if (!on.x.logarithmic && on.x.low <= 0.0 && on.x.high >= 0.0)
    straight(on.at({0.0, on.y.low}), on.at({0.0, on.y.high}), 1.0, grey);
  straight(on.low, {on.high.x(), on.low.y()}, 1.0, black);
  straight(on.low, {on.low.x(), on.high.y()}, 1.0, black);
  const Vec2 middle = 0.5 * (on.low + on.high);
  const int large = static_cast<int>(1.1 * font);
  canvas.text(chart.x_label, {middle.x(), 0.8 * font}, {.size = large, .along = Hold::middle});
  canvas.text(chart.y_label, {0.8 * font, middle.y()},
              {.size = large, .along = Hold::middle, .across = Hold::high, .upwards = true});
}

void draw_curve(Canvas& canvas, const Layout& on, const Curve& curve, const Colour& colour) {
  std::vector<Vec2> places;
  for (const Vec2& value : curve.values)
    places.push_back(on.at(value));
  const double width = on.font / 8.0;
  if (!curve.points && places.size() > 1)
    canvas.line(places, width, colour);
  else
    for (const Vec2& place : places)
      canvas.dot(place, 2.0 * width, colour);
}

/// The corner of the field with the fewest points: there the legend goes. Where several are empty:
/// above rather than below, on the right rather than on the left.
std::array<bool, 2> emptiest_corner(const std::vector<Curve>& curves, const Layout& on) {
  constexpr double wide = 0.35, high = 0.3;
  std::array<int, 4> counts{};
  for (const Curve& curve : curves)
    for (const Vec2& value : curve.values) {
      const double x = on.x.share(value.x()), y = on.y.share(value.y());
      if ((x < wide || x > 1.0 - wide) && (y < high || y > 1.0 - high))
        ++counts[(x > 0.5 ? 1U : 0U) + (y > 0.5 ? 2U : 0U)];
    }
  std::size_t best = 3;
  for (const std::size_t corner : {2U, 1U, 0U})
    best = counts[corner] < counts[best] ? corner : best;
  return {best % 2 == 1, best / 2 == 1};
}

void draw_legend(Canvas& canvas, const Layout& on, const std::vector<Curve>& curves) {
  const double font = on.font, line = 1.5 * font, sample = 2.5 * font;
  double widest = 0.0;
  for (const Curve& curve : curves)
    widest = std::max(widest, Canvas::text_length(curve.label, on.font));
  const Vec2 size(sample + 0.6 * font + widest, line * static_cast<double>(curves.size()));
  const auto [right, top] = emptiest_corner(curves, on);
  const Vec2 first(right ? on.high.x() - font - size.x() : on.low.x() + font,
                   top ? on.high.y() - 0.5 * font : on.low.y() + 0.5 * font + size.y());
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const Vec2 start = first - Vec2(0.0, line * (static_cast<double>(i) + 0.5));
    const Vec2 end = start + Vec2(sample, 0.0);
    if (curves[i].points)
      canvas.dot(0.5 * (start + end), on.font / 4.0, colour_of(i));
    else
      canvas.line(std::array{start, end}, on.font / 8.0, colour_of(i));
    canvas.text(curves[i].label, end + Vec2(0.6 * font, 0.0),
                {.size = on.font, .across = Hold::middle});
  }
}

/// Logarithmic axes have no place for values at or below zero; curves of nothing else go.
void leave_out_what_has_no_logarithm(Chart& chart) {
  const auto has_none = [&](const Vec2& value) {
    return (chart.logarithmic[0] && value.x() <= 0.0) || (chart.logarithmic[1] && value.y() <= 0.0);
  };
  for (Curve& curve : chart.curves)
    std::erase_if(curve.values, has_none);
  std::erase_if(chart.curves, [](const Curve& curve) { return curve.values.empty(); });
  if (chart.curves.empty())
    throw Error(Fault::usage, "", "no value is above zero: a logarithmic axis cannot show them",
                "leave out --log-x or --log-y, or turn the sign: -COLUMN");
}

/// The curves asked for and their axes.
Chart chart_of(const Options& options) {
  const ChartOptions& asked = options.chart;
  Chart chart;
  if (!asked.columns.empty()) {
    chart = columns_of(options.results, asked.columns);
  } else if (asked.series.empty()) {
    chart = load_stroke(options.results);
  } else {
    chart.x_label = asked.series[0].x_column;
    chart.y_label = asked.series[0].y_column;
  }
  for (const Series& series : asked.series)
    chart.curves.push_back(read_curve(series));
  chart.tight = asked.tight;
  chart.logarithmic = asked.logarithmic;
  leave_out_what_has_no_logarithm(chart);
  if (!options.title.empty())
    chart.title = options.title;
  if (!asked.x_label.empty())
    chart.x_label = asked.x_label;
  if (!asked.y_label.empty())
    chart.y_label = asked.y_label;
  return chart;
}

std::string in_words(const Chart& chart) {
  std::string text;
  for (const Curve& curve : chart.curves) {
    const Vec2& last = curve.values.back();
    const Vec2& top = *std::max_element(curve.values.begin(), curve.values.end(),
                                        [](const Vec2& a, const Vec2& b) { return a.y() < b.y(); });
    text +=
        fmt::format("{}curve: {}, {} points, at most {:.6g} at {:.6g}, at last {:.6g} at {:.6g}",
                    text.empty() ? "" : "\n", curve.label, curve.values.size(), top.y(), top.x(),
                    last.y(), last.x());
  }
  const auto scale = [&](std::size_t way) {
    return chart.logarithmic.at(way) ? " (logarithmic)" : "";
  };
  return text +
         fmt::format("\naxes: {}{} over {}{}", chart.y_label, scale(1), chart.x_label, scale(0));
}

} // namespace

std::string draw_chart(const Options& options, const std::filesystem::path& picture) {
  const Chart chart = chart_of(options);
  const Layout layout = layout_of(chart, options.size());
  Canvas canvas(options.size());
  draw_axes(canvas, layout, chart);
  for (std::size_t i = 0; i < chart.curves.size(); ++i)
    draw_curve(canvas, layout, chart.curves[i], colour_of(i));
  draw_legend(canvas, layout, chart.curves);
  canvas.text(
      chart.title,
      {0.5 * (layout.low.x() + layout.high.x()), options.size()[1] - 1.0 * layout.font},
      {.size = static_cast<int>(1.3 * layout.font), .along = Hold::middle, .across = Hold::high});
  canvas.write(picture);
  return in_words(chart);
}

} // namespace billet::render
