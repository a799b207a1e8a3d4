#include "app/render/encoder.h"

#include "geometry/base/error.h"
#include "io/results/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <string_view>
#include <system_error>
#include <vector>

namespace billet::render {

namespace {

constexpr const char* program = "ffmpeg";

bool is_in_path(const std::string& name) {
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');)
    if (::access((folder + "/" + name).c_str(), X_OK) == 0)
      return true;
  return false;
}

/// What ffmpeg is called with.
std::vector<std::string> command(const std::filesystem::path& film,
                                 const std::filesystem::path& partial,
                                 const std::array<int, 2>& size,
                                 double fps) {
  std::vector<std::string> words{program,
                                 "-loglevel",
                                 "error",
                                 "-y",
                                 "-f",
                                 "rawvideo",
                                 "-pixel_format",
                                 "rgb24",
                                 "-video_size",
                                 fmt::format("{}x{}", size[0], size[1]),
                                 "-framerate",
                                 fmt::format("{}", fps),
                                 "-i",
                                 "-"};
  // VTK's rows run from the foot of the picture upwards.
  if (film.extension() == ".gif") {
    // One palette for all frames, from what changes in them; without dithering even colours stay
    // even, and only the part of a frame that changes is stored.
    words.insert(words.end(), {"-filter_complex",
                               "vflip,split[a][b];[a]palettegen=max_colors=160:stats_mode=full[p];"
                               "[b][p]paletteuse=dither=none:diff_mode=rectangle",
                               "-loop", "0", "-f", "gif"});
  } else {
    // Players want even numbers of pixels.
    words.insert(words.end(),
                 {"-vf", "vflip,pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white", "-c:v", "libx264",
                  "-crf", "20", "-pix_fmt", "yuv420p", "-movflags", "+faststart", "-f", "mp4"});
  }
  words.push_back("file:" + partial.string());
  return words;
}

[[noreturn]] void become_encoder(std::vector<std::string> words, int input, int messages) {
  ::prctl(PR_SET_PDEATHSIG, SIGTERM); // ends with us, however we end
  ::dup2(input, STDIN_FILENO);
  ::dup2(messages, STDOUT_FILENO);
  ::dup2(messages, STDERR_FILENO);
  std::vector<char*> argv;
  for (std::string& word : words)
    argv.push_back(word.data());
  argv.push_back(nullptr);
  ::execvp(argv[0], argv.data());
  ::_exit(127);
}

} // namespace

void require_encoder(const std::filesystem::path& film) {
  if (!is_in_path(program))
    throw Error(Fault::input_output, film.string(),
                "GIFs and MP4s are made by the program ffmpeg, which is not installed",
                "apt-get install ffmpeg; or a series of pictures: -o film_%04d.png");
}

Encoder::Encoder(std::filesystem::path film, const std::array<int, 2>& size, double fps)
    : film_(std::move(film)), partial_(film_), messages_(std::tmpfile()) {
  partial_.replace_filename(fmt::format(".{}.{}", film_.filename().string(), ::getpid()));
  if (const int file = ::open(partial_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666); file >= 0)
    ::close(file);
  else
    io::cannot_write(film_, errno);
  std::signal(SIGPIPE, SIG_IGN); // an encoder that ended shows when it is written to
  std::array<int, 2> ends{};
  if (messages_ != nullptr && ::pipe2(ends.data(), O_CLOEXEC) == 0)
    child_ = ::fork();
  if (child_ < 0) {
    const int reason = errno;
    std::error_code ignored;
    std::filesystem::remove(partial_, ignored);
    throw Error(Fault::limit, "",
                fmt::format("no process can be started: {}", std::strerror(reason)));
  }
  if (child_ == 0)
    become_encoder(command(film_, partial_, size, fps), ends[0], ::fileno(messages_.get()));
  ::close(ends[0]);
  pipe_ = ends[1];
}

Encoder::~Encoder() {
  if (child_ > 0) {
    ::kill(child_, SIGTERM);
    (void)wait();
  }
  std::error_code ignored;
  std::filesystem::remove(partial_, ignored);
}

int Encoder::wait() {
  if (pipe_ >= 0)
    ::close(pipe_);
  pipe_ = -1;
  int status = 0;
  while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) {
  }
  child_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

void Encoder::fail() {
  std::string text;
  std::rewind(messages_.get());
  std::array<char, 400> buffer{};
  while (text.size() < buffer.size() && std::fgets(buffer.data(), buffer.size(), messages_.get()))
    text += buffer.data();
  while (!text.empty() && text.back() == '\n')
    text.pop_back();
  throw Error(Fault::input_output, film_.string(),
              "ffmpeg could not write the film" + (text.empty() ? "" : ": " + text),
              "a series of pictures needs no ffmpeg: -o film_%04d.png");
}

void Encoder::add(vtkImageData& image) {
  const auto n = static_cast<std::size_t>(image.GetNumberOfPoints()) * 3;
  const std::string_view bytes(static_cast<const char*>(image.GetScalarPointer()), n);
  if (io::write_all(pipe_, bytes) != 0) {
    (void)wait();
    fail();
  }
}

void Encoder::finish() {
  if (wait() != 0)
    fail();
  std::error_code error;
  std::filesystem::rename(partial_, film_, error);
  if (error)
    io::cannot_write(film_, error.value());
}

} // namespace billet::render
