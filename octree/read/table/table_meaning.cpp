#include "octree/read/table/table_meaning.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "octree/core/error.h"

namespace stipple {
namespace {

constexpr std::pair<std::string_view, std::string_view> kNames[] = {
    {"reflectance", "intensity"},
    {"class", "classification"},
    {"returnnumber", "return number"},
    {"return_number", "return number"},
    {"numberofreturns", "number of returns"},
    {"number_of_returns", "number of returns"},
    {"gpstime", "gps-time"},
    {"gps_time", "gps-time"},
    {"pointsourceid", "point source id"},
    {"point_source_id", "point source id"},
    {"userdata", "user data"},
    {"user_data", "user data"},
    {"scananglerank", "scan angle"},
    {"scan_angle_rank", "scan angle"},
    {"scanangle", "scan angle"},
    {"scan_angle", "scan angle"},
    {"normal_x", "nx"},
    {"normal_y", "ny"},
    {"normal_z", "nz"},
    {"diffuse_alpha", "alpha"},
};

// Names that Potree 2.0, and every reader, spells like this.
constexpr std::string_view kOwnNames[] = {"intensity", "classification", "nx", "ny", "nz", "alpha"};

constexpr std::array<std::string_view, 3> kColors[] = {
    {"red", "green", "blue"}, {"r", "g", "b"}, {"diffuse_red", "diffuse_green", "diffuse_blue"}};

std::string lower(std::string_view text) {
  std::string result(text);
  std::ranges::transform(result, result.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

std::string plain(std::string_view name) {
  std::string result = lower(name);
  constexpr std::string_view kPrefix = "scalar_";
  return result.starts_with(kPrefix) && result.size() > kPrefix.size() ? result.substr(kPrefix.size()) : result;
}

// The name as an attribute has it.
std::string attribute_name(const std::string& name) {
  const std::string known = plain(name);
  for (const auto& [from, to] : kNames)
    if (known == from) return std::string(to);
  return std::ranges::find(kOwnNames, known) != std::end(kOwnNames) ? known : name;
}

class Reader {
 public:
  explicit Reader(const std::vector<TableField>& fields) : fields_(fields), used_(fields.size(), false) {
    for (std::size_t f = 0; f < fields_.size(); ++f) used_[f] = fields_[f].name == "_";
  }

  std::optional<std::size_t> take(std::string_view name) {
    const auto found = find(name);
    if (found) used_[*found] = true;
    return found;
  }

  // Takes what makes the colour, if anything does.
  void take_colors(std::vector<Derivation>& attributes) {
    for (const auto& names : kColors) {
      const std::array found{find(names[0]), find(names[1]), find(names[2])};
      if (!found[0] || !found[1] || !found[2]) continue;
      for (const auto& field : found) used_[*field] = true;
      attributes.push_back({rgb(), Derivation::Kind::color, {{{*found[0]}, {*found[1]}, {*found[2]}}}});
      return;
    }
    for (const char* name : {"rgb", "rgba"})
      for (std::size_t f = 0; f < fields_.size(); ++f)
        if (!used_[f] && plain(fields_[f].name) == name && take_rgb(f, name == std::string_view("rgba"), attributes))
          return;
  }

  void take_rest(std::vector<Derivation>& attributes) {
    for (std::size_t f = 0; f < fields_.size(); ++f) {
      if (used_[f]) continue;
      const TableField& field = fields_[f];
      attributes.push_back({{unused_name(attributes, field.name), field.type, field.components, 1.0, 0.0},
                            Derivation::Kind::copy,
                            {{{f}}}});
    }
  }

 private:
  static Attribute rgb() { return {"rgb", ScalarType::u16, 3, 1.0, 0.0}; }

  // A single number, by the name in any case, not used yet.
  std::optional<std::size_t> find(std::string_view name) const {
    for (std::size_t f = 0; f < fields_.size(); ++f)
      if (!used_[f] && fields_[f].components == 1 && lower(fields_[f].name) == name) return f;
    return std::nullopt;
  }

  bool take_rgb(std::size_t f, bool with_alpha, std::vector<Derivation>& attributes) {
    const TableField& field = fields_[f];
    if (field.components == 3) {
      attributes.push_back({rgb(), Derivation::Kind::color, {{{f, 0}, {f, 1}, {f, 2}}}});
    } else if (field.components == 1 && size_of(field.type) == 4) {
      attributes.push_back({rgb(), Derivation::Kind::packed_color, {{{f}}}});
      if (with_alpha)
        attributes.push_back({{"alpha", ScalarType::u8, 1, 1.0, 0.0}, Derivation::Kind::packed_alpha, {{{f}}}});
    } else {
      return false;
    }
    used_[f] = true;
    return true;
  }

  // Names are unique: a second "intensity" keeps the name it has in the file, or gets a number.
  static std::string unused_name(const std::vector<Derivation>& attributes, const std::string& name) {
    const auto used = [&](const std::string& wanted) {
      return std::ranges::any_of(attributes, [&](const Derivation& d) { return d.attribute.name == wanted; });
    };
    std::string wanted = attribute_name(name);
    if (used(wanted)) wanted = name;
    for (int number = 2; used(wanted); ++number) wanted = fmt::format("{} {}", name, number);
    return wanted;
  }

  const std::vector<TableField>& fields_;
  std::vector<bool> used_;
};

}  // namespace

bool is_coordinate(std::string_view name) {
  const std::string known = lower(name);
  return known == "x" || known == "y" || known == "z";
}

TableMeaning meaning_of(const std::vector<TableField>& fields, const std::string& place) {
  Reader reader(fields);
  TableMeaning meaning;
  meaning.position = {reader.take("x"), reader.take("y"), reader.take("z")};
  if (!meaning.position[0] || !meaning.position[1]) {
    std::vector<std::string> names;
    for (const TableField& field : fields) names.push_back(field.name);
    throw Error(fmt::format("{} the points have no {}; they have: {}. Positions were expected as x, y and z.", place,
                            meaning.position[0] ? "y" : "x",
                            names.empty() ? "nothing" : fmt::to_string(fmt::join(names, " "))));
  }
  reader.take_colors(meaning.attributes);
  reader.take_rest(meaning.attributes);
  return meaning;
}

}  // namespace stipple
