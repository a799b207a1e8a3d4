#include "geometry/base/error.h"
#include "io/text/home_folder.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

namespace billet::io::home_folder_test {
namespace {

TEST(HomeFolder, stands_for_a_tilde_at_the_start) {
  const std::string home = std::getenv("HOME") != nullptr ? std::getenv("HOME") : "";
  ::setenv("HOME", "/home/eve", 1);
  EXPECT_EQ(with_home_folder("~/results/x", "-o"), "/home/eve/results/x");
  EXPECT_EQ(with_home_folder("~", "-o"), "/home/eve");
  for (const char* path : {"x", "./~/x", "/tmp/~x", "x~", ""})
    EXPECT_EQ(with_home_folder(path, "-o"), path);
  ::setenv("HOME", home.c_str(), 1);
}

TEST(HomeFolder, of_another_user_or_unknown_is_refused_with_a_remedy) {
  const std::string home = std::getenv("HOME") != nullptr ? std::getenv("HOME") : "";
  for (const auto& [path, says] :
       {std::pair{"~bob/x", "only '~/' stands for a home folder"}, {"~/x", "HOME does not name"}}) {
    ::setenv("HOME", "", 1);
    try {
      (void)with_home_folder(path, "--output");
      ADD_FAILURE() << path;
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::usage);
      for (const std::string& text : {std::string(says), std::string("--output: found '") + path,
                                      std::string("'./") + path + "'"})
        EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
    }
  }
  ::setenv("HOME", home.c_str(), 1);
}

} // namespace
} // namespace billet::io::home_folder_test
