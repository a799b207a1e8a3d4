#include "app/render/picture.h"

#include "io/results/atomic_file.h"

#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include <string_view>

namespace billet::render {

void write_picture(vtkImageData& image, const std::filesystem::path& path) {
  const vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(&image);
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray* bytes = writer->GetResult();
  io::write_file(path, std::string_view(reinterpret_cast<const char*>(bytes->GetPointer(0)),
                                        static_cast<std::size_t>(bytes->GetNumberOfValues())));
}

void write_picture(vtkRenderWindow& window, const std::filesystem::path& path) {
  window.Render();
  const vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(&window);
  image->ReadFrontBufferOff();
  image->Update();
  write_picture(*image->GetOutput(), path);
}

} // namespace billet::render
