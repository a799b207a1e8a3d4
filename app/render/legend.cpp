#include "app/render/legend.h"

#include "app/render/canvas.h"
#include "app/render/picture.h"

#include <fmt/format.h>
#include <vtkNew.h>
#include <vtkScalarBarActor.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <string>

namespace billet::render {

namespace {

constexpr int smallest_font = 8 * samples_a_side, largest_font = 40 * samples_a_side;

/// A text cut off where it would be wider than there is room, with dots.
std::string cut_off(std::string text, int font, double width) {
  if (Canvas::text_length(text, font) <= width)
    return text;
  while (!text.empty() && Canvas::text_length(text + "...", font) > width) {
    text.pop_back();
    while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xC0U) == 0xC0U)
      text.pop_back(); // not half of a letter
  }
  return text + "...";
}

/// A name in lines short enough for the scale: broken behind '_' and ':'.
std::string broken(const std::string& name, std::size_t longest) {
  std::string text, line;
  for (std::size_t i = 0; i < name.size(); ++i) {
    line += name[i];
    const std::size_t next = std::min(name.find_first_of("_:", i + 1), name.size());
    if ((name[i] == '_' || name[i] == ':') && line.size() + next - i > longest) {
      text += line + "\n";
      line.clear();
    }
  }
  return text + line;
}

std::string label_format(const std::array<double, 2>& range) {
  const double largest = std::max(std::abs(range[0]), std::abs(range[1]));
  const double length = range[1] - range[0];
  if (largest >= 1e5 || largest < 1e-3)
    return "%.2e";
  return length >= 50.0   ? "%.0f"
         : length >= 5.0  ? "%.1f"
         : length >= 0.5  ? "%.2f"
         : length >= 0.05 ? "%.3f"
                          : "%.4g";
}

} // namespace

Sheet::Sheet(const std::array<int, 2>& picture, bool with_scale, int caption_lines)
    : size(picture),
      font(std::clamp(std::min(picture[0] * 3 / 4, picture[1]) / 45, smallest_font, largest_font)) {
  const double height = size[1];
  constexpr double scale_fonts = 10.0, least = 0.12, most = 0.3;
  right = with_scale ? 1.0 - std::clamp(scale_fonts * font / size[0], least, most) : 1.0;
  top = std::max(0.6, 1.0 - 2.4 * font / height);
  bottom = std::min(0.3, (0.9 + 1.4 * caption_lines) * font / height);
}

void add_text(vtkRenderer& overlay,
              const std::string& text,
              const std::array<double, 2>& place,
              int font,
              double width,
              bool centred) {
  const double length = Canvas::text_length(text, font);
  if (length > width)
    font = std::max(smallest_font, static_cast<int>(font * width / length));
  const vtkNew<vtkTextActor> actor;
  actor->SetInput(cut_off(text, font, width).c_str());
  vtkTextProperty& property = *actor->GetTextProperty();
  property.SetColor(0.0, 0.0, 0.0);
  property.SetFontSize(font);
  if (centred)
    property.SetJustificationToCentered();
  actor->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  actor->SetPosition(place[0], place[1]);
  overlay.AddActor2D(actor);
}

void add_scale(vtkRenderer& margin,
               vtkLookupTable& map,
               const Shown& shown,
               const ColourRange& range,
               const Sheet& sheet,
               const std::optional<int>& bands) {
  const vtkNew<vtkScalarBarActor> bar;
  bar->SetLookupTable(&map);
  const double width = (1.0 - sheet.right) * sheet.size[0];
  const std::string name = broken(shown.name, 15);
  const std::string title = name + (shown.unit.empty() ? "" : "\n[" + shown.unit + "]");
  double longest = 1.0;
  for (std::size_t at = 0; at < name.size();) {
    const std::size_t end = std::min(name.find('\n', at), name.size());
    longest = std::max(longest, Canvas::text_length(name.substr(at, end - at), sheet.font));
    at = end + 1;
  }
  const int font = std::max(
      smallest_font, std::min(sheet.font, static_cast<int>(sheet.font * 0.84 * width / longest)));
  bar->SetTitle(title.c_str());
  constexpr int most_labels = 11;
  bar->SetNumberOfLabels(bands && *bands < most_labels ? *bands + 1 : 6);
  bar->SetMaximumNumberOfColors(256);
  bar->SetVerticalTitleSeparation(font);
  bar->SetLabelFormat(label_format(range.colours).c_str());
  bar->UnconstrainedFontSizeOn();
  for (vtkTextProperty* text : {bar->GetTitleTextProperty(), bar->GetLabelTextProperty()}) {
    text->SetColor(0.0, 0.0, 0.0);
    text->ItalicOff();
    text->BoldOff();
    text->ShadowOff();
    text->SetFontSize(font);
  }
  bar->SetPosition(0.08, 0.2);
  bar->SetWidth(0.8);
  bar->SetHeight(0.62);
  margin.AddActor2D(bar);
  const int small = std::max(smallest_font, font * 3 / 4);
  const double line = 1.5 * small / sheet.size[1];
  const auto note = [&](const std::string& text, int row) {
    add_text(margin, text, {0.08, 0.03 + row * line}, small, 0.9 * width, false);
  };
  note("colours: " + range.span(), 2);
  note(fmt::format("largest {:.4g}", range.all[1]), 1);
  note(fmt::format("smallest {:.4g}", range.all[0]), 0);
}

} // namespace billet::render
