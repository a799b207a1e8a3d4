// What VTK finds in a .vtu file, unchecked.

#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace billet::io {

/// An array over the points that may be a set: integers, one a point.
struct VtuArray {
  std::string name;
  std::vector<double> values;
};

/// A type of cells that the file has.
struct VtuType {
  int number;
  std::string name; ///< "unknown cells" if VTK has none
  int dimension;
};

/// A .vtu file.
struct VtuContent {
  std::string complaint; ///< the first of VTK's; empty: it could be read
  bool exceeds_memory = false;
  std::vector<double> points; ///< shape (n, 3)
  bool has_offsets = false;
  std::vector<std::int64_t> offsets; ///< of the cells and of their end
  std::vector<double> nodes;         ///< of all cells
  std::vector<int> types;            ///< of the cells
  std::vector<VtuType> known_types;  ///< each of them once
  std::vector<VtuArray> arrays;
  std::string unit_system = {}; ///< that a frame of results names; empty: it is none
};

/// Collects VTK's messages instead of printing them, as long as it lives.
class CapturedMessages {
public:
  CapturedMessages();
  ~CapturedMessages();
  CapturedMessages(const CapturedMessages&) = delete;
  CapturedMessages& operator=(const CapturedMessages&) = delete;

  /// The essence of the first message; empty if there was none.
  [[nodiscard]] std::string first() const;

private:
  struct Windows;
  std::unique_ptr<Windows> windows_;
};

/// Reads a file with VTK.
[[nodiscard]] VtuContent vtu_content(const std::filesystem::path& path);

} // namespace billet::io
