#include "app/render/film.h"

#include "app/render/display.h"
#include "app/render/encoder.h"
#include "app/render/picture.h"
#include "app/render/scene.h"
#include "geometry/base/error.h"

#include <fmt/format.h>
#include <vtkImageData.h>
#include <vtkNew.h>

#include <algorithm>
#include <cmath>

namespace billet::render {

namespace {

/// The name of one picture of a series: a number in place of %d or %04d.
class SeriesName {
public:
  explicit SeriesName(const std::filesystem::path& pattern) : folder_(pattern.parent_path()) {
    const std::string name = pattern.filename().string();
    const std::size_t sign = name.find('%'), end = name.find('d', sign);
    const std::string digits =
        end == std::string::npos ? "x" : name.substr(sign + 1, end - sign - 1);
    constexpr std::size_t longest = 2;
    if (digits.find_first_not_of("0123456789") != std::string::npos || digits.size() > longest ||
        name.find('%', sign + 1) != std::string::npos || pattern.extension() != ".png")
      throw Error(Fault::usage, "--output",
                  fmt::format("\"{}\" is not the name of a series of pictures", name),
                  "film_%04d.png is one: a number of four digits takes the place of %04d");
    head_ = name.substr(0, sign);
    tail_ = name.substr(end + 1);
    width_ = digits.empty() ? 0 : std::stoi(digits);
  }
  [[nodiscard]] std::filesystem::path operator()(int number) const {
    return folder_ / fmt::format("{}{:0{}d}{}", head_, number, width_, tail_);
  }

private:
  std::filesystem::path folder_;
  std::string head_, tail_;
  int width_ = 0;
};

std::string write_series(const Scene& scene, const Options& options, const SeriesName& name) {
  const Display display;
  const auto window = window_of(options.size());
  int number = 0;
  for (const Picture& picture : scene.pictures()) {
    scene.draw(picture, *window);
    write_picture(*window, name(number++));
  }
  return fmt::format("frames: {}, {} to {}\n{}", number, name(0).filename().string(),
                     name(number - 1).filename().string(), scene.in_words());
}

std::string encode(const Scene& scene, const Options& options, const std::filesystem::path& file) {
  const Display display;
  const auto window = window_of(options.size());
  Encoder encoder(file, options.size(), options.film.rate());
  vtkNew<vtkImageData> last;
  for (const Picture& picture : scene.pictures()) {
    scene.draw(picture, *window);
    last->DeepCopy(image_of(*window));
    encoder.add(*last);
  }
  // The end is what one wants to look at: it stays for a second.
  const int more = std::clamp(static_cast<int>(std::lround(options.film.rate())), 1, 60);
  for (int i = 0; i < more; ++i)
    encoder.add(*last);
  encoder.finish();
  return fmt::format(
      "frames: {}, {:.4g} a second, {:.3g} MB\n{}", scene.pictures().size(), options.film.rate(),
      1e-6 * static_cast<double>(std::filesystem::file_size(file)), scene.in_words());
}

} // namespace

std::string draw_film(const Options& options, const std::filesystem::path& file) {
  if (file.filename().string().find('%') != std::string::npos) {
    const SeriesName name(file);
    return write_series(Scene(options), options, name);
  }
  require_encoder(file);
  return encode(Scene(options), options, file);
}

} // namespace billet::render
