#include "app/render/canvas.h"

#include "app/render/picture.h"
#include "geometry/base/error.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>

#include <algorithm>
#include <cmath>

namespace billet::render {

namespace {

constexpr int dots_per_inch = 72; // a font of 16 is 16 pixels high

double distance(const Vec2& x, const Vec2& a, const Vec2& b) {
  const Vec2 along = b - a;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0.0 ? std::clamp((x - a).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (x - a - t * along).norm();
}

/// How much of a pixel is covered, by the distance of its middle to a shape's edge, negative
/// inside.
double coverage(double outside) { return std::clamp(0.5 - outside, 0.0, 1.0); }

vtkTextRenderer& text_renderer() {
  vtkTextRenderer* const renderer = vtkTextRenderer::GetInstance();
  if (renderer == nullptr)
    throw Error(Fault::input_output, "", "VTK is without fonts, no text can be drawn");
  return *renderer;
}

void set_font(vtkTextProperty& font, const TextStyle& style) {
  font.SetFontFamilyToArial();
  font.SetFontSize(style.size);
  font.SetColor(style.colour[0] / 255.0, style.colour[1] / 255.0, style.colour[2] / 255.0);
  font.SetOrientation(style.upwards ? 90.0 : 0.0);
}

/// Of what is held at a place, the part before that place.
double before(Hold hold, double length) {
  return hold == Hold::low ? 0.0 : hold == Hold::middle ? 0.5 * length : length;
}

} // namespace

Canvas::Canvas(const std::array<int, 2>& size)
    : size_(size),
      pixels_(3 * static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]), 255) {}

Canvas::Window Canvas::window(const Vec2& low, const Vec2& high) const {
  Window window{};
  for (int d = 0; d < 2; ++d) {
    const auto i = static_cast<std::size_t>(d);
    const double most = size_[i];
    window.low[i] = static_cast<int>(std::clamp(std::floor(low[d]), 0.0, most));
    window.high[i] = static_cast<int>(std::clamp(std::ceil(high[d]), 0.0, most));
  }
  return window;
}

void Canvas::blend(std::size_t pixel, const Colour& colour, double share) {
  for (std::size_t c = 0; c < 3; ++c) {
    std::uint8_t& value = pixels_[3 * pixel + c];
    value = static_cast<std::uint8_t>(std::lround(value + share * (colour[c] - value)));
  }
}

// Pieces of a line overlap: each pixel is mixed once, by the most that covers it.
void Canvas::line(std::span<const Vec2> points, double width, const Colour& colour) {
  std::vector<float> covered(pixels_.size() / 3, 0.0F);
  const Vec2 margin = Vec2::Constant(0.5 * width + 1.0);
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Vec2& a = points[i];
    const Vec2& b = points[i + 1];
    const Window near = window(a.cwiseMin(b) - margin, a.cwiseMax(b) + margin);
    for (int y = near.low[1]; y < near.high[1]; ++y)
      for (int x = near.low[0]; x < near.high[0]; ++x) {
        float& most = covered[index(x, y)];
        most = std::max(
            most, static_cast<float>(coverage(distance({x + 0.5, y + 0.5}, a, b) - 0.5 * width)));
      }
  }
  for (std::size_t i = 0; i < covered.size(); ++i)
    if (covered[i] > 0.0F)
      blend(i, colour, static_cast<double>(covered[i]));
}

void Canvas::dot(const Vec2& centre, double radius, const Colour& colour) {
  const Vec2 margin = Vec2::Constant(radius + 1.0);
  const Window near = window(centre - margin, centre + margin);
  for (int y = near.low[1]; y < near.high[1]; ++y)
    for (int x = near.low[0]; x < near.high[0]; ++x)
      blend(index(x, y), colour, coverage((Vec2(x + 0.5, y + 0.5) - centre).norm() - radius));
}

void Canvas::text(const std::string& text, const Vec2& at, const TextStyle& style) {
  if (text.empty())
    return;
  const vtkNew<vtkTextProperty> font;
  set_font(*font, style);
  const vtkNew<vtkImageData> image;
  std::array<int, 2> dims{};
  if (!text_renderer().RenderString(font, text, image, dims.data(), dots_per_inch))
    throw Error(Fault::input_output, "", "the text \"" + text + "\" cannot be drawn");
  const Vec2 held =
      style.upwards ? Vec2(dims[0] - before(style.across, dims[0]), before(style.along, dims[1]))
                    : Vec2(before(style.along, dims[0]), before(style.across, dims[1]));
  const int left = static_cast<int>(std::lround(at.x() - held.x()));
  const int foot = static_cast<int>(std::lround(at.y() - held.y()));
  const int* const extent = image->GetExtent(); // of turned text it does not begin at zero
  for (int y = 0; y < dims[1]; ++y)
    for (int x = 0; x < dims[0]; ++x) {
      const int px = left + x, py = foot + y;
      if (px < 0 || py < 0 || px >= size_[0] || py >= size_[1])
        continue;
      constexpr int opacity = 3;
      blend(index(px, py), style.colour,
            image->GetScalarComponentAsDouble(extent[0] + x, extent[2] + y, 0, opacity) / 255.0);
    }
}

double Canvas::text_length(const std::string& text, int size) {
  if (text.empty())
    return 0.0;
  const vtkNew<vtkTextProperty> font;
  set_font(*font, {.size = size});
  std::array<int, 4> box{};
  text_renderer().GetBoundingBox(font, text, box.data(), dots_per_inch);
  return box[1] - box[0] + 1;
}

void Canvas::write(const std::filesystem::path& path) const {
  const vtkNew<vtkImageData> image;
  image->SetDimensions(size_[0], size_[1], 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  std::copy(pixels_.begin(), pixels_.end(), static_cast<std::uint8_t*>(image->GetScalarPointer()));
  write_picture(*image, path);
}

} // namespace billet::render
