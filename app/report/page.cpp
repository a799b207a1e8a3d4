#include "app/report/page.h"

#include "app/report/frame_view.h"
#include "app/report/html.h"
#include "app/report/page_style.h"
#include "app/report/sections.h"
#include "app/report/svg_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <utility>

namespace billet::report {

namespace {

using nlohmann::ordered_json;

constexpr std::size_t most_points_of_a_curve = 1500;

std::string whole_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// JSON that may stand in a <script>: no text in it can end the element.
std::string embedded(const ordered_json& json) {
  std::string text = json.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at + 1))
    text.replace(at, 1, "\\u003c");
  return text;
}

/// A script of others may hold "</script" in a text, where a backslash changes nothing.
std::string safe_script(std::string text) {
  for (std::size_t at = text.find("</script"); at != std::string::npos;
       at = text.find("</script", at + 1))
    text.insert(at + 1, "\\");
  return text;
}

ordered_json data_of(const NamedChart& named) {
  ordered_json chart{{"id", named.id},
                     {"x", named.chart.x_label},
                     {"y", named.chart.y_label},
                     {"logarithmic", named.logarithmic},
                     {"over_time", named.over_time}};
  chart["curves"] = ordered_json::array();
  for (const render::Curve& curve : named.chart.curves) {
    ordered_json points{
        {"label", curve.label}, {"x", ordered_json::array()}, {"y", ordered_json::array()}};
    for (const Vec2& value : thinned(curve.values, most_points_of_a_curve)) {
      points["x"].push_back(std::stod(fmt::format("{:.7g}", value[0])));
      points["y"].push_back(std::stod(fmt::format("{:.7g}", value[1])));
    }
    chart["curves"].push_back(std::move(points));
  }
  return chart;
}

std::string charts_section(const std::vector<NamedChart>& charts) {
  if (charts.empty())
    return {};
  std::string html = "<div class=\"charts\">\n";
  for (const NamedChart& named : charts)
    html += fmt::format("<figure class=\"chart\" id=\"chart-{}\"><h3>{}</h3>\n{}</figure>\n",
                        escaped(named.id), escaped(named.chart.title), svg_of(named));
  return section("curves", "Curves", html + "</div>\n");
}

std::string head_of(const ResultsFolder& results, const PageSettings& settings) {
  std::string head = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                     "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
  head += "<title>" + escaped(results.title) + " – billet report</title>\n";
  // Nothing is loaded from anywhere, whatever a text of the case says.
  head += "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
          "script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:\">\n";
  if (settings.reload_after)
    head +=
        settings.bundle
            ? fmt::format("<meta name=\"reload-after\" content=\"{}\">\n", *settings.reload_after)
            : fmt::format("<meta http-equiv=\"refresh\" content=\"{}\">\n", *settings.reload_after);
  head += "<style>\n" + std::string(page_style) + "</style>\n";
  if (settings.bundle)
    head += "<style>\n" + settings.bundle->style + "</style>\n";
  return head + "</head>\n";
}

std::string view_section(const FrameView& view, bool has_bundle) {
  std::string html;
  if (!has_bundle)
    html =
        "<p class=\"missing\">This program was built without the view of the frames: "
        "<code>./dev build --report</code> builds it. <code>billet render</code> draws pictures, "
        "ParaView opens the <code>.pvd</code> of the results.</p>\n";
  else if (view.scene.is_null())
    html = "<p class=\"missing\">There are no frames to show.</p>\n";
  else
    html = "<div id=\"view\"><noscript>The view of the frames needs JavaScript.</noscript></div>\n";
  if (has_bundle && !view.notes.empty())
    html += "<div class=\"notes\">" + list(view.notes) + "</div>\n";
  return section("frames", "Frames", html);
}

std::string data_of_page(const std::vector<NamedChart>& charts,
                         const FrameView& view,
                         const ResultsFolder& results) {
  ordered_json data{{"state", results.status()}, {"view", view.scene}};
  data["charts"] = ordered_json::array();
  for (const NamedChart& named : charts)
    data["charts"].push_back(data_of(named));
  std::string html =
      "<script type=\"application/json\" id=\"billet-data\">" + embedded(data) + "</script>\n";
  for (std::size_t i = 0; i < view.blobs.size(); ++i)
    html +=
        fmt::format("<script type=\"text/plain\" id=\"blob-{}\">{}</script>\n", i, view.blobs[i]);
  return html;
}

/// Everything but the view of the frames.
struct Parts {
  std::string head, top, tables, end;
};

Parts parts_of(const ResultsFolder& results,
               const PageSettings& settings,
               const std::vector<NamedChart>& charts) {
  Parts parts;
  parts.head = head_of(results, settings);
  parts.top = fmt::format("<body>\n<header><h1>{}</h1></header>\n<main>\n", escaped(results.title));
  parts.top += status_section(results) + key_figures(results, charts);
  parts.tables = charts_section(charts) + tools_section(results) + blows_section(results) +
                 measures_section(results) + wear_section(results) + window_section(results) +
                 laps_section(results) + remeshing_section(results) +
                 section("run", "What was run", run_section(results)) + effort_section(results);
  if (settings.bundle)
    parts.end = folded("Licences of what this page contains",
                       "<pre>" + escaped(settings.bundle->licences) + "</pre>\n", false);
  parts.end += "</main>\n";
  return parts;
}

} // namespace

std::optional<Bundle> find_bundle(const std::filesystem::path& program) {
  const std::filesystem::path folder = program.parent_path().parent_path() / "share" / "billet";
  Bundle bundle{whole_text(folder / "report.js"), whole_text(folder / "report.css"),
                whole_text(folder / "report-licences.txt")};
  return bundle.script.empty() ? std::nullopt : std::optional(std::move(bundle));
}

std::string page_of(const ResultsFolder& results, const PageSettings& settings) {
  const std::vector<NamedChart> charts = curves_of(results);
  const Parts parts = parts_of(results, settings, charts);
  std::string script;
  if (settings.bundle)
    script = "<script>\n" + safe_script(settings.bundle->script) + "</script>\n";
  FrameView view;
  const std::string without_view = data_of_page(charts, view, results);
  const std::size_t used = parts.head.size() + parts.top.size() + parts.tables.size() +
                           parts.end.size() + script.size() + without_view.size();
  constexpr std::size_t descriptions = 400'000; // of what the blobs hold
  if (settings.bundle)
    view = frame_view(results,
                      settings.most_bytes - std::min(settings.most_bytes, used + descriptions));
  return parts.head + parts.top + view_section(view, settings.bundle.has_value()) + parts.tables +
         parts.end + (settings.bundle ? data_of_page(charts, view, results) + script : "") +
         "</body>\n</html>\n";
}

} // namespace billet::report
