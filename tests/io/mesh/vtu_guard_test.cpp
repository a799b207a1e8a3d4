#include "geometry/base/error.h"
#include "io/mesh/vtu_guard.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace billet::io::vtu_guard_test {
namespace {

/// A file with one array, compressed unless told otherwise.
std::string file(const std::string& array,
                 const std::string& attributes = "compressor=\"vtkZLibDataCompressor\" "
                                                 "header_type=\"UInt64\"") {
  return fmt::format("<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\" {}>\n{}",
                     attributes, array);
}

bool accepted(const std::string& content) {
  try {
    require_plausible_vtu(content, "part.vtu");
    return true;
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::geometry);
    EXPECT_EQ(error.complaints().front().place, "part.vtu");
    return false;
  }
}

const std::string inline_array = "<DataArray type=\"Float64\" format=\"binary\">\n  ";

TEST(VtuGuard, lets_a_sound_header_pass) {
  // 1 block of 32768, the last of 8 bytes
  EXPECT_TRUE(accepted(file(inline_array + "AQAAAAAAAAAAgAAAAAAAAAgAAAAAAAAADQAAAAAAAAA=eF5j")));
  EXPECT_TRUE(accepted(file(inline_array + "AAAAAAAAAAA=</DataArray>"))) << "an empty array";
}

TEST(VtuGuard, refuses_blocks_of_no_size_which_vtk_divides_by) {
  EXPECT_FALSE(accepted(file(inline_array + "AQAAAAAAAAAAAAAAAAAAAAgAAAAAAAAADQAAAAAAAAA=eF5j")));
}

TEST(VtuGuard, refuses_numbers_and_sizes_of_blocks_that_cannot_be) {
  EXPECT_FALSE(accepted(file(inline_array + "AQAAAAAAAHAAgAAAAAAAAAgAAAAAAAAADQAAAAAAAAA=eF5j")));
  EXPECT_FALSE(accepted(file(inline_array + "AQAAAAAAAAAAgAAAAAAAcAgAAAAAAAAADQAAAAAAAAA=eF5j")));
  EXPECT_FALSE(accepted(file(inline_array + "AQAAAAAAAAAAgAAA</DataArray>"))) << "cut short";
  EXPECT_FALSE(accepted(file(inline_array + "AQAAAAAAAAAAgAAAAAAAAAgAAAAAAAAADQAAAAAAAHA=eF5j")))
      << "a block larger than the file";
}

TEST(VtuGuard, looks_only_at_compressed_data_for_headers) {
  EXPECT_TRUE(
      accepted(file(inline_array + "AQAAAAAAAAAAAAAAAAAAAAgAAAAAAAAADQAAAAAAAAA=eF5j", "")));
}

TEST(VtuGuard, follows_the_offset_of_appended_data) {
  const std::string array = "<DataArray type=\"Int64\" format=\"appended\" offset=\"{}\"/>"
                            "<AppendedData encoding=\"base64\">_{}</AppendedData></VTKFile>";
  const std::string sound = "AQAAAAAAAAAAgAAAAAAAAAgAAAAAAAAADQAAAAAAAAA=eF5j";
  const std::string without_size = "AQAAAAAAAAAAAAAAAAAAAAgAAAAAAAAADQAAAAAAAAA=eF5j";
  EXPECT_TRUE(accepted(file(fmt::format(fmt::runtime(array), 0, sound))));
  EXPECT_FALSE(accepted(file(fmt::format(fmt::runtime(array), 0, without_size))));
  EXPECT_FALSE(
      accepted(file(fmt::format(fmt::runtime(array), sound.size(), sound + without_size))));
  EXPECT_FALSE(accepted(file(fmt::format(fmt::runtime(array), 5000, sound))));
}

TEST(VtuGuard, refuses_what_is_not_an_unstructured_grid) {
  EXPECT_FALSE(accepted(""));
  EXPECT_FALSE(accepted("<VTKFile type=\"PolyData\">"));
  EXPECT_FALSE(accepted("UnstructuredGrid"));
}

} // namespace
} // namespace billet::io::vtu_guard_test
