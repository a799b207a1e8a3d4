// The result tables of a run, read back.

#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace billet::test {

struct ResultTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows; ///< as written

  [[nodiscard]] std::size_t index(const std::string& column) const {
    for (std::size_t c = 0; c < columns.size(); ++c)
      if (columns[c] == column)
        return c;
    ADD_FAILURE() << "no column " << column;
    return 0;
  }
  [[nodiscard]] double value(std::size_t row, const std::string& column) const {
    return std::strtod(rows.at(row).at(index(column)).c_str(), nullptr);
  }
  [[nodiscard]] std::vector<double> values(const std::string& column) const {
    std::vector<double> all;
    for (std::size_t row = 0; row < rows.size(); ++row)
      all.push_back(value(row, column));
    return all;
  }
  /// The rows without the one column that no two runs share.
  [[nodiscard]] std::vector<std::vector<std::string>> without_wall_time() const {
    auto all = rows;
    const auto wall = static_cast<std::ptrdiff_t>(index("wall_time"));
    for (auto& row : all)
      row.erase(row.begin() + wall);
    return all;
  }
};

inline std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');)
    cells.push_back(cell);
  return cells;
}

/// Every row must be whole.
inline ResultTable read_table(const std::filesystem::path& path) {
  ResultTable table;
  std::ifstream stream(path);
  std::string line;
  EXPECT_TRUE(std::getline(stream, line)) << path << " is empty";
  table.columns = split(line);
  while (std::getline(stream, line)) {
    EXPECT_FALSE(stream.eof()) << path << " ends within a row";
    table.rows.push_back(split(line));
    EXPECT_EQ(table.rows.back().size(), table.columns.size()) << path << ": " << line;
  }
  return table;
}

/// What a .pvd lists: time, part and file.
struct ListedFile {
  double time;
  std::string part;
  std::string file;
};

inline std::vector<ListedFile> read_list(const std::filesystem::path& path) {
  const auto attribute = [](const std::string& line, const std::string& name) {
    const std::size_t at = line.find(name + "=\"") + name.size() + 2;
    return line.substr(at, line.find('"', at) - at);
  };
  std::vector<ListedFile> list;
  std::ifstream stream(path);
  EXPECT_TRUE(stream.is_open()) << path;
  for (std::string line; std::getline(stream, line);)
    if (line.find("<DataSet") != std::string::npos)
      list.push_back({std::strtod(attribute(line, "timestep").c_str(), nullptr),
                      attribute(line, "name"), attribute(line, "file")});
  return list;
}

/// Times of the frames of the workpiece.
inline std::vector<double> frame_times(const std::filesystem::path& list) {
  std::vector<double> times;
  for (const ListedFile& entry : read_list(list))
    if (entry.part == "workpiece")
      times.push_back(entry.time);
  return times;
}

/// Everything in the folder is whole: no temporary file, the list names files that are there and
/// end as they must, the last frame belongs to an increment of the table.
inline void expect_whole_results(const std::filesystem::path& folder, const std::string& name) {
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    EXPECT_EQ(entry.path().string().find(".partial"), std::string::npos) << entry.path();
  const auto list = read_list(folder / (name + ".pvd"));
  EXPECT_FALSE(list.empty());
  for (const ListedFile& entry : list) {
    std::ifstream stream(folder / entry.file);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    EXPECT_NE(text.find("</VTKFile>"), std::string::npos) << entry.file;
  }
  const ResultTable history = read_table(folder / "history.csv");
  if (!list.empty() && list.back().time > 0.0 && !history.rows.empty()) {
    EXPECT_LE(list.back().time, history.value(history.rows.size() - 1, "time") * (1.0 + 1e-12));
  }
  read_table(folder / "iterations.csv");
}

} // namespace billet::test
