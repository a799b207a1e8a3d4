// Pictures to a film, by the program ffmpeg, which reads them through a pipe.
//
// VTK 9.1 of Debian is built without FFmpeg, and has no writer of GIFs
// (docs/decisions/0035-films-by-ffmpeg.md). VTK in a header: only for sources of this folder.

#pragma once

#include <sys/types.h>
#include <vtkImageData.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

namespace billet::render {

/// @throws Error  (Fault::input_output) where ffmpeg is not there; before anything is drawn
void require_encoder(const std::filesystem::path& film);

class Encoder {
public:
  /// @param film  its suffix says what it becomes: .gif or .mp4
  Encoder(std::filesystem::path film, const std::array<int, 2>& size, double fps);
  /// Without `finish` nothing is left of the film.
  ~Encoder();
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;

  /// @throws Error  (Fault::input_output) with what ffmpeg says
  void add(vtkImageData& image);
  /// The film is there, whole, when this returns.
  /// @throws Error  (Fault::input_output) with what ffmpeg says
  void finish();

private:
  struct Closed {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  [[nodiscard]] int wait();
  [[noreturn]] void fail();

  std::filesystem::path film_, partial_;
  std::unique_ptr<std::FILE, Closed> messages_;
  int pipe_ = -1;
  ::pid_t child_ = -1;
};

} // namespace billet::render
