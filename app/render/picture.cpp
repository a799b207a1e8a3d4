#include "app/render/picture.h"

#include "io/results/atomic_file.h"

#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace billet::render {

namespace {

/// Each pixel the mean of a square of the image's.
vtkSmartPointer<vtkImageData> means_of(vtkImageData& image) {
  constexpr int n = samples_a_side, channels = 3;
  const int width = image.GetDimensions()[0] / n, height = image.GetDimensions()[1] / n;
  auto means = vtkSmartPointer<vtkImageData>::New();
  means->SetDimensions(width, height, 1);
  means->AllocateScalars(VTK_UNSIGNED_CHAR, channels);
  const auto* const from = static_cast<const std::uint8_t*>(image.GetScalarPointer());
  auto* to = static_cast<std::uint8_t*>(means->GetScalarPointer());
  const std::size_t row = channels * static_cast<std::size_t>(image.GetDimensions()[0]);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (std::size_t c = 0; c < channels; ++c) {
        unsigned sum = n * n / 2;
        for (int j = 0; j < n; ++j)
          for (int i = 0; i < n; ++i)
            sum += from[static_cast<std::size_t>(n * y + j) * row +
                        channels * static_cast<std::size_t>(n * x + i) + c];
        *to++ = static_cast<std::uint8_t>(sum / (n * n));
      }
  return means;
}

} // namespace

void write_picture(vtkImageData& image, const std::filesystem::path& path) {
  const vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(&image);
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray* bytes = writer->GetResult();
  io::write_file(path, std::string_view(reinterpret_cast<const char*>(bytes->GetPointer(0)),
                                        static_cast<std::size_t>(bytes->GetNumberOfValues())));
}

vtkSmartPointer<vtkImageData> image_of(vtkRenderWindow& window) {
  window.Render();
  const vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(&window);
  image->ReadFrontBufferOff();
  image->Update();
  return means_of(*image->GetOutput());
}

void write_picture(vtkRenderWindow& window, const std::filesystem::path& path) {
  write_picture(*image_of(window), path);
}

} // namespace billet::render
