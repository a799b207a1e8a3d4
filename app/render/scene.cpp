#include "app/render/scene.h"

#include "app/render/arrows.h"
#include "app/render/display.h"
#include "app/render/legend.h"
#include "app/render/picture.h"
#include "app/render/tools.h"
#include "geometry/base/error.h"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkRendererCollection.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace billet::render {

namespace {

constexpr std::array<double, 3> dark{0.15, 0.15, 0.15};
constexpr std::array<double, 3> steel{0.62, 0.66, 0.72};
constexpr std::array<double, 3> pale{0.86, 0.86, 0.86};
constexpr std::array<double, 3> red{0.80, 0.06, 0.20};

Box box_of(vtkDataSet& data) {
  std::array<double, 6> bounds{};
  data.GetBounds(bounds.data());
  Box box;
  box.add({bounds[0], bounds[2], bounds[4]});
  box.add({bounds[1], bounds[3], bounds[5]});
  return box;
}

void add_box(Box& all, const Box& more) {
  if (!more.empty()) {
    all.add(more.low);
    all.add(more.high);
  }
}

/// The length that half of the lines' pieces exceed.
double usual_length(vtkPolyData& lines) {
  std::vector<double> lengths;
  const vtkNew<vtkIdList> ids;
  for (vtkIdType i = 0; i < lines.GetNumberOfCells(); ++i) {
    lines.GetCellPoints(i, ids);
    std::array<double, 3> a{}, b{};
    lines.GetPoint(ids->GetId(0), a.data());
    lines.GetPoint(ids->GetId(ids->GetNumberOfIds() - 1), b.data());
    lengths.push_back(std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]));
  }
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return lengths.empty() ? 0.0 : *middle;
}

/// Lines of a fine mesh are faint: they would take the colours from what lies beneath.
double opacity_of(double length_in_pixels) {
  constexpr double full = 14.0, faintest = 0.12;
  return std::clamp(length_in_pixels / full, faintest, 1.0);
}

double largest_vector(vtkDataArray& vectors) {
  double largest = 0.0;
  for (vtkIdType i = 0; i < vectors.GetNumberOfTuples(); ++i)
    if (const double length = std::hypot(vectors.GetComponent(i, 0), vectors.GetComponent(i, 1),
                                         vectors.GetComponent(i, 2));
        std::isfinite(length))
      largest = std::max(largest, length);
  return largest;
}

} // namespace

Scene::Scene(const Options& options) : options_(options) {
  results_.push_back(std::make_unique<Results>(options.results.front()));
  if (options.scene.compare)
    results_.push_back(std::make_unique<Results>(*options.scene.compare));
  choose_pictures();
  const Source& last = pictures_.back().back();
  const Frame& frame = last.results->frame(last.time);
  shown_ = find_shown(frame, options.scene);
  if (!options.scene.arrows.empty())
    require_vectors(frame, options.scene.arrows);
  const Box box = box_of(*frame.workpiece);
  const bool planar = box.high.z() - box.low.z() <= 1e-9 * box.size();
  if (options.scene.revolve && text_in(*frame.workpiece, "analysis") != "axisymmetric")
    throw Error(Fault::usage, "--revolve", "the scene is not axisymmetric",
                "--mirror completes a part with planes of symmetry, --copies a sector");
  if (options.scene.flow_lines && !planar)
    throw Error(Fault::usage, "--flow-lines", "only scenes of the plane have them");
  if (options.scene.copies > 1 && planar)
    throw Error(Fault::usage, "--copies", "copies complete a sector of a part in space",
                "--mirror completes a part of the plane, --revolve an axisymmetric one");
  flat_ = planar && !options.scene.revolve;
  sight_ = sight_of(options.scene.view, flat_, options.scene.revolve.has_value());
  extent_ = Extent(sight_);
  measure();
}

void Scene::choose_pictures() {
  const Results& results = *results_.front();
  const auto with_others = [&](double time) {
    Picture picture{{&results, time}};
    if (results_.size() > 1)
      picture.push_back({results_[1].get(), results_[1]->nearest(time)});
    return picture;
  };
  if (options_.film.wanted) {
    const FrameSlice slice = options_.film.slice.value_or(FrameSlice());
    const auto n = static_cast<int>(results.times().size());
    for (int i = slice.first; i < n && i <= slice.last; i += slice.step)
      pictures_.push_back(with_others(results.times()[static_cast<std::size_t>(i)]));
    if (pictures_.empty())
      throw Error(Fault::usage, "--frames",
                  fmt::format("there is no frame {}: the results have {}", slice.first, n));
  } else if (options_.scene.times.size() > 1) {
    Picture& picture = pictures_.emplace_back();
    for (const AskedTime& time : options_.scene.times)
      picture.push_back({&results, results.nearest(time)});
  } else {
    const AskedTime time =
        options_.scene.times.empty() ? AskedTime() : options_.scene.times.front();
    pictures_.push_back(with_others(results.nearest(time)));
    if (!time && results_.size() > 1) // the last of both
      pictures_.back()[1].time = results_[1]->nearest(time);
  }
}

Completion Scene::completion_of(const Frame& frame) const {
  const std::vector<AxisPlane> planes = mirror_planes(*frame.workpiece, options_.scene);
  Completion completion;
  completion.revolve = options_.scene.revolve;
  completion.copies = copies_of(planes, options_.scene.copies, sight_.axis_up);
  completion.sides = sides_of(planes, *frame.workpiece);
  if (completion.revolve)
    completion.sides.push_back({Vec3::UnitX(), 0.0});
  completion.removed = removed_by(options_.scene.cuts, sight_.towards);
  completion.flat = flat_;
  return completion;
}

void Scene::measure() {
  measure_parts();
  if (!options_.scene.arrows.empty())
    extent_.grow(arrow_length());
  check_cuts();
  constexpr double margin_share = 0.15;
  const Vec3 margin = Vec3::Constant(margin_share * part_.size());
  window_ = Box{part_.low - margin, part_.high + margin};
  if (options_.scene.tools != ToolStyle::none)
    measure_tools();
}

void Scene::measure_parts() {
  std::vector<double> values;
  for (const Picture& picture : pictures_)
    for (const Source& source : picture) {
      const Frame& frame = source.results->frame(source.time);
      if (source.results != results_.front().get())
        (void)find_shown(frame, options_.scene); // complains where it is not there
      const std::vector<double> more = values_of(frame, shown_);
      values.insert(values.end(), more.begin(), more.end());
      add_box(part_, box_of(*frame.workpiece));
      const Completion completion = completion_of(frame);
      const Body body = body_of(frame, shown_, options_.scene, completion);
      extent_.add(*body.faces);
      Completion uncut = completion;
      uncut.removed.clear();
      add_box(whole_, box_of(*(completion.removed.empty()
                                   ? body.faces
                                   : body_of(frame, shown_, options_.scene, uncut).faces)));
      if (vtkDataArray* const vectors =
              frame.workpiece->GetPointData()->GetArray(options_.scene.arrows.c_str()))
        longest_vector_ = std::max(longest_vector_, largest_vector(*vectors));
    }
  range_ = colour_range(values, options_.scene.range);
}

void Scene::measure_tools() {
  for (const Picture& picture : pictures_)
    for (const Source& source : picture) {
      const Frame& frame = source.results->frame(source.time);
      Shown plain;
      plain.plain = true;
      for (const DrawnTool& tool : tools_of(frame, plain, completion_of(frame), window_))
        for (const auto& data : {tool.faces, tool.lines})
          if (data != nullptr)
            extent_.add(*data);
    }
}

void Scene::check_cuts() const {
  for (const Cut& cut : options_.scene.cuts)
    for (const CutPlane& plane : cut) {
      const int d = plane.plane.axis;
      if (plane.plane.at > whole_.low[d] && plane.plane.at < whole_.high[d])
        continue;
      const char name = axis_names[static_cast<std::size_t>(d)];
      throw Error(
          Fault::usage, "--cut",
          fmt::format("the plane {}={:g} does not cut the part", name, plane.plane.at),
          fmt::format("it reaches from {}={:.6g} to {:.6g}", name, whole_.low[d], whole_.high[d]));
    }
}

void Scene::draw_tools(Stage& stage, const Frame& frame) const {
  const ToolStyle style = options_.scene.tools;
  if (style == ToolStyle::none)
    return;
  const bool coloured = shown_.on == Place::tools && !shown_.plain;
  const double lift = 2e-3 * whole_.size();
  const auto map = colour_map(range_.colours, options_.scene.bands);
  for (const DrawnTool& tool : tools_of(frame, shown_, completion_of(frame), window_)) {
    vtkPolyData* const faces = tool.faces;
    const bool of_plane = faces == nullptr && flat_;
    vtkPolyData* const body = of_plane ? tool.lines.Get() : faces;
    const bool has_values = coloured && body != nullptr &&
                            (body->GetPointData()->HasArray(Shown::values) != 0 ||
                             body->GetCellData()->HasArray(Shown::values) != 0);
    if (has_values)
      stage.add_coloured(*body, *map, 7.0F, 2.0 * lift);
    else if (faces != nullptr && style == ToolStyle::glass)
      stage.add_glass(*faces);
    else if (faces != nullptr && style == ToolStyle::solid)
      stage.add_plain(*faces, steel, true);
    if (tool.lines != nullptr && !(of_plane && has_values))
      stage.add_lines(
          *tool.lines,
          of_plane ? Pen{3.5F, {0.1, 0.1, 0.1}, 1.0, lift}
                   : Pen{1.5F, {0.3, 0.3, 0.3}, 1.0, 0.0, style == ToolStyle::solid ? 12.0 : 1.0});
  }
}

double Scene::arrow_length() const {
  constexpr double usual_share = 0.1;
  return usual_share * options_.scene.arrow_scale * whole_.size();
}

void Scene::draw_arrows(Stage& stage, vtkPolyData& faces) const {
  const double size = whole_.size();
  const auto arrows = arrows_on(faces, size, longest_vector_, arrow_length());
  if (arrows == nullptr)
    return;
  Pen pen{1.0F, red, 1.0, 0.05 * size};
  stage.add_lines(*arrows, pen);
}

void Scene::draw_frame(Stage& stage, const Frame& frame, double pixel) const {
  const Completion completion = completion_of(frame);
  const Body body = body_of(frame, shown_, options_.scene, completion);
  const auto map = colour_map(range_.colours, options_.scene.bands);
  const bool on_part = !shown_.plain && shown_.on == Place::workpiece;
  const double size = whole_.size();
  const bool on_tools = !shown_.plain && shown_.on == Place::tools;
  if (on_part)
    stage.add_coloured(*body.faces, *map, 1.0F, 0.0);
  else if (on_tools)
    stage.add_glass(*body.faces); // the part is in front of what is shown
  else
    stage.add_plain(*body.faces, pale);
  if (body.lines != nullptr && !on_tools) {
    const double opacity =
        options_.scene.flow_lines ? 1.0 : opacity_of(usual_length(*body.lines) / pixel);
    stage.add_lines(*body.lines,
                    {options_.scene.flow_lines ? 1.5F : 1.0F, dark, opacity, 1e-3 * size});
  }
  if (!shown_.plain && shown_.on == Place::contact && frame.contact != nullptr &&
      frame.contact->GetNumberOfCells() > 0) {
    const vtkNew<vtkPolyData> faces;
    faces->ShallowCopy(frame.contact);
    add_values(*faces, shown_);
    stage.add_coloured(*completed(*faces, completion), *map, 7.0F, 1.5e-3 * size);
  }
  draw_tools(stage, frame);
  if (!options_.scene.arrows.empty())
    draw_arrows(stage, *body.faces);
}

std::string Scene::caption(const Source& source) const {
  const Frame& frame = source.results->frame(source.time);
  std::string unit = text_in(*frame.workpiece, "unit of displacement");
  const std::string time = fmt::format("t = {:.4g} s", source.time);
  const std::optional<double> way = source.results->stroke(source.time);
  std::string text = way ? fmt::format("{}, stroke {:.4g} {}", time, *way, unit) : time;
  if (results_.size() > 1)
    text = source.results->name() + ": " + text;
  return text;
}

void Scene::draw(const Picture& picture, vtkRenderWindow& window) const {
  window.GetRenderers()->RemoveAllItems();
  const bool with_scale = !shown_.plain;
  const bool with_arrows = !options_.scene.arrows.empty();
  const std::array<int, 2> size = options_.size();
  const Sheet sheet({samples_a_side * size[0], samples_a_side * size[1]}, with_scale,
                    with_arrows ? 2 : 1);
  const auto n = static_cast<double>(picture.size());
  const double width = sheet.right * sheet.size[0] / n;
  const double height = (sheet.top - sheet.bottom) * sheet.size[1];
  const Aim aim = aim_at(extent_, sight_, options_.scene.view, width / height);
  const vtkNew<vtkRenderer> paper, overlay;
  for (vtkRenderer* layer : {paper.Get(), overlay.Get()}) {
    layer->SetBackground(1.0, 1.0, 1.0);
    layer->InteractiveOff();
  }
  overlay->SetLayer(1);
  window.AddRenderer(paper); // white where nothing else is
  for (std::size_t i = 0; i < picture.size(); ++i) {
    const double left = sheet.right * static_cast<double>(i) / n;
    Stage stage(flat_);
    stage.enter(window, {left, sheet.bottom, left + sheet.right / n, sheet.top});
    draw_frame(stage, picture[i].results->frame(picture[i].time),
               2.0 * samples_a_side * aim.half_height / height);
    stage.look(aim, sight_);
    const double foot =
        0.5 * sheet.font / sheet.size[1] + (with_arrows ? 1.4 : 0.0) * sheet.font / sheet.size[1];
    add_text(*overlay, caption(picture[i]), {left + 0.5 * sheet.font / sheet.size[0], foot},
             sheet.font, width - sheet.font, false);
  }
  if (with_arrows) {
    const std::string unit = text_in(*picture[0].results->frame(picture[0].time).workpiece,
                                     "unit of " + options_.scene.arrows);
    add_text(*overlay,
             fmt::format("arrows: {}, the longest {:.4g} {}", options_.scene.arrows,
                         longest_vector_, unit),
             {0.5 * sheet.font / sheet.size[0], 0.5 * sheet.font / sheet.size[1]}, sheet.font,
             sheet.right * sheet.size[0], false);
  }
  const std::string title = options_.title.empty() ? results_.front()->title() : options_.title;
  add_text(*overlay, title,
           {0.5 * sheet.font / sheet.size[0], 1.0 - 1.8 * sheet.font / sheet.size[1]},
           sheet.font * 6 / 5, sheet.size[0] - sheet.font, false);
  window.AddRenderer(overlay);
  if (!with_scale)
    return;
  const vtkNew<vtkRenderer> margin;
  margin->SetViewport(sheet.right, 0.0, 1.0, sheet.top);
  margin->SetLayer(1);
  margin->InteractiveOff();
  const auto map = colour_map(range_.colours, options_.scene.bands);
  add_scale(*margin, *map, shown_, range_, sheet, options_.scene.bands);
  window.AddRenderer(margin);
}

std::string Scene::in_words() const {
  if (shown_.plain)
    return "colours: none";
  const std::string unit = shown_.unit.empty() ? "" : " " + shown_.unit;
  return fmt::format("colours: {} from {:.6g} to {:.6g}{}, {}; all values {:.6g} to {:.6g}{}",
                     shown_.name, range_.colours[0], range_.colours[1], unit, range_.span(),
                     range_.all[0], range_.all[1], unit);
}

std::string Scene::times_outside() const {
  const std::vector<double>& known = results_.front()->times();
  std::string lines;
  for (const AskedTime& time : options_.scene.times)
    if (time && (*time < known.front() || *time > known.back()))
      lines += fmt::format("\ntime {:g} s lies outside of the results, from {:g} to {:g} s: the "
                           "frame at {:g} s is drawn",
                           *time, known.front(), known.back(), results_.front()->nearest(time));
  return lines;
}

vtkSmartPointer<vtkRenderWindow> window_of(const std::array<int, 2>& size) {
  auto window = vtkSmartPointer<vtkRenderWindow>::New();
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(samples_a_side * size[0], samples_a_side * size[1]);
  window->SetNumberOfLayers(2);
  return window;
}

std::string draw_scene(const Options& options, const std::filesystem::path& picture) {
  const Scene scene(options);
  const Display display; // mistakes are told without one
  const auto window = window_of(options.size());
  scene.draw(scene.pictures().front(), *window);
  write_picture(*window, picture);
  return scene.in_words() + scene.times_outside();
}

} // namespace billet::render
