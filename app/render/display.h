// A display to draw scenes on, where there is none: one of Xvfb's, for as long as it is needed.

#pragma once

#include <sys/types.h>

namespace billet::render {

/// The display that DISPLAY names; where it names none, an Xvfb of our own, which ends with this.
/// It takes the first free number itself, so that pictures can be drawn side by side.
class Display {
public:
  /// @throws Error  (Fault::input_output) where Xvfb does not start: VTK would end the program
  ///                without a word
  Display();
  ~Display();
  Display(const Display&) = delete;
  Display& operator=(const Display&) = delete;

private:
  ::pid_t server_ = -1;
};

} // namespace billet::render
