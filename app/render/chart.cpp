#include "app/render/chart.h"

#include "app/render/picture.h"
#include "geometry/base/error.h"

#include <fmt/format.h>
#include <vtkAxis.h>
#include <vtkChartLegend.h>
#include <vtkChartXY.h>
#include <vtkContextScene.h>
#include <vtkContextView.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPen.h>
#include <vtkPlotPoints.h>
#include <vtkRenderer.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>
#include <vtkVariant.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

namespace billet::render {

namespace {

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) {
    const auto first = cell.find_first_not_of(" \t\r\"");
    const auto last = cell.find_last_not_of(" \t\r\"");
    cells.push_back(first == std::string::npos ? "" : cell.substr(first, last - first + 1));
  }
  return cells;
}

/// A column of a table and the sign it is drawn with.
struct Column {
  std::size_t position;
  double sign;
};

Column find_column(const std::vector<std::string>& header,
                   const std::string& asked,
                   const std::filesystem::path& file) {
  for (const double sign : {1.0, -1.0}) {
    if (sign < 0.0 && !asked.starts_with('-'))
      break;
    const auto found =
        std::find(header.begin(), header.end(), sign > 0.0 ? asked : asked.substr(1));
    if (found != header.end())
      return {static_cast<std::size_t>(found - header.begin()), sign};
  }
  std::string known;
  for (const std::string& name : header)
    known += (known.empty() ? "" : ", ") + name;
  throw Error(Fault::usage, file.string(), fmt::format("the table has no column \"{}\"", asked),
              fmt::format("it has {}", known));
}

/// The points of a series; lines that begin with # are comments, rows that lack a number are left
/// out.
vtkNew<vtkTable> read_series(const Series& series) {
  std::ifstream stream(series.file);
  if (!stream)
    throw Error(Fault::input_output, series.file.string(),
                fmt::format("the table cannot be read: {}", std::strerror(errno)));
  const vtkNew<vtkDoubleArray> x;
  const vtkNew<vtkDoubleArray> y;
  x->SetName("x");
  y->SetName(series.label.c_str());
  std::optional<std::array<Column, 2>> columns;
  for (std::string line; std::getline(stream, line);) {
    const std::vector<std::string> cells = cells_of(line);
    if (cells.empty() || line.starts_with('#'))
      continue;
    if (!columns) {
      columns = {find_column(cells, series.x_column, series.file),
                 find_column(cells, series.y_column, series.file)};
      continue;
    }
    std::array<double, 2> values{};
    bool whole = true;
    for (std::size_t i = 0; i < 2; ++i) {
      const Column& column = (*columns)[i];
      char* end = nullptr;
      const char* text = column.position < cells.size() ? cells[column.position].c_str() : "";
      values[i] = column.sign * std::strtod(text, &end);
      whole = whole && end != text;
    }
    if (whole) {
      x->InsertNextValue(values[0]);
      y->InsertNextValue(values[1]);
    }
  }
  if (x->GetNumberOfValues() == 0)
    throw Error(Fault::input_output, series.file.string(), "the table has no rows of numbers");
  vtkNew<vtkTable> table;
  table->AddColumn(x);
  table->AddColumn(y);
  return table;
}

/// The corner with the fewest points: there the legend goes.
std::array<bool, 2> emptiest_corner(const std::vector<vtkTable*>& tables) {
  std::array<std::array<double, 2>, 2> ranges{{{1e300, -1e300}, {1e300, -1e300}}};
  for (vtkTable* table : tables)
    for (vtkIdType axis = 0; axis < 2; ++axis)
      for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row) {
        auto& range = ranges[static_cast<std::size_t>(axis)];
        range[0] = std::min(range[0], table->GetValue(row, axis).ToDouble());
        range[1] = std::max(range[1], table->GetValue(row, axis).ToDouble());
      }
  std::array<int, 4> counts{};
  for (vtkTable* table : tables)
    for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row) {
      std::array<double, 2> place{};
      for (std::size_t axis = 0; axis < 2; ++axis)
        place[axis] =
            (table->GetValue(row, static_cast<vtkIdType>(axis)).ToDouble() - ranges[axis][0]) /
            (ranges[axis][1] - ranges[axis][0]);
      const bool edge_x = place[0] < 0.35 || place[0] > 0.65;
      const bool edge_y = place[1] < 0.3 || place[1] > 0.7;
      if (edge_x && edge_y)
        ++counts[(place[0] > 0.5 ? 1U : 0U) + (place[1] > 0.5 ? 2U : 0U)];
    }
  // Where several are empty: above rather than below, on the right rather than on the left.
  std::size_t best = 3;
  for (const std::size_t corner : {2U, 1U, 0U})
    best = counts[corner] < counts[best] ? corner : best;
  return {best % 2 == 1, best / 2 == 1};
}

vtkTable* add_series(vtkChartXY& chart, const Series& series, std::size_t number) {
  // Colours that the colour-blind can tell apart (Okabe and Ito).
  constexpr std::array<std::array<unsigned char, 3>, 6> colours{
      {{0, 114, 178}, {213, 94, 0}, {0, 158, 115}, {204, 121, 167}, {86, 180, 233}, {0, 0, 0}}};
  const auto& [red, green, blue] = colours[number % colours.size()];
  const vtkNew<vtkTable> table = read_series(series);
  vtkPlot* plot = chart.AddPlot(series.points ? vtkChart::POINTS : vtkChart::LINE);
  plot->SetInputData(table, 0, 1);
  plot->SetColor(red, green, blue, 255);
  plot->SetWidth(series.points ? 8.0F : 2.5F);
  if (auto* markers = vtkPlotPoints::SafeDownCast(plot); markers != nullptr && series.points) {
    markers->SetMarkerStyle(vtkPlotPoints::CIRCLE);
    markers->SetMarkerSize(9.0F);
  }
  return plot->GetInput();
}

void label_axis(vtkAxis& axis, const std::string& label) {
  axis.SetTitle(label);
  axis.GetTitleProperties()->SetFontSize(18);
  axis.GetTitleProperties()->BoldOff();
  axis.GetLabelProperties()->SetFontSize(15);
}

} // namespace

void draw_chart(const Options& options) {
  const vtkNew<vtkChartXY> chart;
  std::vector<vtkTable*> tables;
  for (std::size_t i = 0; i < options.series.size(); ++i)
    tables.push_back(add_series(*chart, options.series[i], i));
  chart->SetTitle(options.title);
  chart->GetTitleProperties()->SetFontSize(22);
  chart->SetShowLegend(true);
  chart->GetLegend()->SetLabelSize(16);
  const auto [right, top] = emptiest_corner(tables);
  chart->GetLegend()->SetHorizontalAlignment(right ? vtkChartLegend::RIGHT : vtkChartLegend::LEFT);
  chart->GetLegend()->SetVerticalAlignment(top ? vtkChartLegend::TOP : vtkChartLegend::BOTTOM);
  label_axis(*chart->GetAxis(vtkAxis::BOTTOM),
             options.x_label.empty() ? options.series[0].x_column : options.x_label);
  label_axis(*chart->GetAxis(vtkAxis::LEFT),
             options.y_label.empty() ? options.series[0].y_column : options.y_label);

  const vtkNew<vtkContextView> view;
  view->GetRenderer()->SetBackground(1.0, 1.0, 1.0);
  view->GetRenderWindow()->SetOffScreenRendering(1);
  view->GetRenderWindow()->SetMultiSamples(0);
  view->GetRenderWindow()->SetSize(options.size[0], options.size[1]);
  view->GetScene()->AddItem(chart);
  write_picture(*view->GetRenderWindow(), options.output);
}

} // namespace billet::render
