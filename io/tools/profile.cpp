#include "io/tools/profile.h"

#include "geometry/base/error.h"
#include "io/case/document.h"
#include "io/text/toml_library.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace billet::io {

namespace {

using geometry::Profile;
using geometry::ProfileSegment;

// Collects every complaint of one file.
class Reader {
public:
  explicit Reader(std::filesystem::path path) : path_(std::move(path)) {}

  Profile read() {
    Profile profile;
    if (const std::optional<toml::table> file = parse())
      profile = read(*file);
    // The shape as a whole is worth a look only once its parts are sound.
    if (complaints_.empty())
      for (const std::string& what : geometry::flaws(profile))
        complaints_.push_back({path_.string(), what, ""});
    if (!complaints_.empty())
      throw Error(Fault::geometry, std::move(complaints_));
    return profile;
  }

private:
  std::optional<toml::table> parse() {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path_, error)) {
      complaints_.push_back({path_.string(), "there is no such file", "", error_code::file});
      return std::nullopt;
    }
    std::ifstream in(path_, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    try {
      guard_text(text, path_.string());
      return toml::parse(text, path_.string());
    } catch (const BrokenInvariant& broken) {
      complaints_.push_back({path_.string(),
                             fmt::format("not valid TOML (parser: {})", broken.condition), "",
                             error_code::toml_syntax});
    } catch (const Error& refusal) {
      complaints_ = refusal.complaints();
    } catch (const toml::parse_error& e) {
      complain(e.source(), std::string(e.description()));
    }
    return std::nullopt;
  }

  Profile read(const toml::table& file) {
    Profile profile;
    check_keys(file, {"closed", "start", "segment", "points"});
    if (const toml::node* closed = file.get("closed"))
      profile.closed = boolean(*closed, "closed");
    const toml::node* points = file.get("points");
    const toml::node* start = file.get("start");
    const toml::node* segments = file.get("segment");
    if (points != nullptr && (start != nullptr || segments != nullptr))
      complain(points->source(), "'points' stands next to 'start' or 'segment'",
               "give either points or start and segments");
    else if (points != nullptr)
      read_points(*points, profile);
    else if (start == nullptr || segments == nullptr)
      complain(file.source(),
               fmt::format("'{}' is missing", start == nullptr ? "start" : "segment"),
               "a profile needs start and [[segment]], or points");
    else
      read_segments(*start, *segments, profile);
    return profile;
  }

  void read_points(const toml::node& node, Profile& profile) {
    const toml::array* list = node.as_array();
    if (list == nullptr || list->size() < 2) {
      complain(node.source(), "'points' must be a list of at least two [x, y]");
      return;
    }
    std::optional<Vec2> from;
    for (const toml::node& item : *list) {
      const std::optional<Vec2> to = point(item, "points");
      if (to && from)
        add(item, *from, {*to}, profile);
      else if (to && &item == list->get(0))
        profile.start = *to;
      from = to;
    }
  }

  void read_segments(const toml::node& start, const toml::node& node, Profile& profile) {
    std::optional<Vec2> from = point(start, "start");
    profile.start = from.value_or(Vec2::Zero());
    const toml::array* list = node.as_array();
    if (list == nullptr || list->empty()) {
      complain(node.source(), "'segment' must be a list of tables, [[segment]]");
      return;
    }
    for (const toml::node& item : *list) {
      const toml::table* table = item.as_table();
      if (table == nullptr) {
        complain(item.source(), "a segment must be a table");
        from.reset();
        continue;
      }
      const std::optional<ProfileSegment> to = segment(*table);
      if (to && from)
        add(item, *from, *to, profile);
      from = to ? std::optional(to->to) : std::nullopt;
    }
  }

  std::optional<ProfileSegment> segment(const toml::table& table) {
    check_keys(table, {"to", "radius", "large"});
    const toml::node* to = table.get("to");
    if (to == nullptr) {
      complain(table.source(), "'to' is missing", "every segment needs to = [x, y]");
      return std::nullopt;
    }
    const std::optional<Vec2> end = point(*to, "to");
    ProfileSegment segment{end.value_or(Vec2::Zero())};
    if (const toml::node* radius = table.get("radius")) {
      segment.radius = number(*radius, "radius").value_or(0.0);
      if (segment.radius == 0.0 && radius->is_number())
        complain(radius->source(), "radius is 0", "leave it out for a line");
    }
    if (const toml::node* large = table.get("large"))
      segment.large = boolean(*large, "large");
    return end ? std::optional(segment) : std::nullopt;
  }

  void add(const toml::node& at, const Vec2& from, const ProfileSegment& to, Profile& profile) {
    if (const std::optional<std::string> what = geometry::flaw(from, to))
      complain(at.source(), *what);
    profile.segments.push_back(to);
  }

  std::optional<Vec2> point(const toml::node& node, std::string_view key) {
    const toml::array* list = node.as_array();
    if (list == nullptr || list->size() != 2) {
      complain(node.source(), fmt::format("'{}' must be [x, y]", key));
      return std::nullopt;
    }
    const std::optional<double> x = number(*list->get(0), key), y = number(*list->get(1), key);
    return x && y ? std::optional(Vec2(*x, *y)) : std::nullopt;
  }

  std::optional<double> number(const toml::node& node, std::string_view key) {
    const std::optional<double> value = node.is_number() ? node.value<double>() : std::nullopt;
    if (value && std::isfinite(*value))
      return value;
    complain(node.source(), fmt::format("'{}' must be a finite number", key));
    return std::nullopt;
  }

  bool boolean(const toml::node& node, std::string_view key) {
    if (!node.is_boolean())
      complain(node.source(), fmt::format("'{}' must be true or false", key));
    return node.value_or(false);
  }

  void check_keys(const toml::table& table, std::initializer_list<std::string_view> known) {
    for (const auto& [key, node] : table)
      if (std::find(known.begin(), known.end(), key.str()) == known.end())
        complain(key.source(), fmt::format("unknown key '{}'", key.str()),
                 fmt::format("known keys are {}", fmt::join(known, ", ")));
  }

  void complain(const toml::source_region& at, std::string message, std::string remedy = {}) {
    complaints_.push_back({fmt::format("{}:{}:{}", path_.string(), at.begin.line, at.begin.column),
                           std::move(message), std::move(remedy)});
  }

  std::filesystem::path path_;
  std::vector<Complaint> complaints_;
};

} // namespace

geometry::Profile read_profile(const std::filesystem::path& path) { return Reader(path).read(); }

} // namespace billet::io
