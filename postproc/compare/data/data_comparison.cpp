#include "postproc/compare/data/data_comparison.h"
#include "postproc/text/plain_time.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace burnish {
namespace {

constexpr double kSameTime = 1e-9;  ///< of the largest time
constexpr std::size_t kNamedTimes = 5;

using TimePair =
    std::pair<std::size_t, std::size_t>;  ///< numbers of the actual and of the baseline's instant

struct MatchedTimes {
  std::vector<TimePair> pairs;
  std::vector<double> onlyActual, onlyBaseline;
};

MatchedTimes matchTimes(const DataSeries& actual, const DataSeries& baseline) {
  if (!actual.isTimed && !baseline.isTimed) return {{{0, 0}}, {}, {}};
  MatchedTimes matched;
  double largest = 0.0;
  for (const double time : baseline.times) largest = std::max(largest, std::abs(time));
  std::size_t a = 0, b = 0;
  while (a < actual.times.size() && b < baseline.times.size()) {
    const double difference = actual.times[a] - baseline.times[b];
    if (std::abs(difference) <= kSameTime * largest)
      matched.pairs.emplace_back(a++, b++);
    else if (difference < 0.0)
      matched.onlyActual.push_back(actual.times[a++]);
    else
      matched.onlyBaseline.push_back(baseline.times[b++]);
  }
  for (; a < actual.times.size(); ++a) matched.onlyActual.push_back(actual.times[a]);
  for (; b < baseline.times.size(); ++b) matched.onlyBaseline.push_back(baseline.times[b]);
  return matched;
}

std::string timesInWords(const std::vector<double>& times) {
  const std::size_t named = std::min(times.size(), kNamedTimes);
  std::vector<double> first(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(named));
  std::ranges::transform(first, first.begin(), plainTime);
  return fmt::format("{} ({}{})", times.size(), fmt::join(first, ", "), times.size() > named ? ", ..." : "");
}

FieldComparison comparedTimes(const std::string& name, const MatchedTimes& matched) {
  FieldComparison result;
  result.name = name;
  std::vector<std::string> parts;
  if (!matched.onlyBaseline.empty())
    parts.push_back("missing times of the baseline: " + timesInWords(matched.onlyBaseline));
  if (!matched.onlyActual.empty())
    parts.push_back("times that the baseline does not have: " + timesInWords(matched.onlyActual));
  if (parts.empty()) {
    result.message = fmt::format("equal ({} times)", matched.pairs.size());
    return result;
  }
  result.verdict = FieldVerdict::TimesDiffer;
  result.message =
      fmt::format("times differ: {}; {} in common", fmt::join(parts, "; "), matched.pairs.size());
  return result;
}

std::string withDetail(const std::string& name, const DataPart& part) {
  return part.detail.empty() ? name : fmt::format("{} ({})", name, part.detail);
}

const DataPart* samePart(const DataFrame& frame, const DataPart& part) {
  const auto found = std::ranges::find_if(
      frame, [&](const DataPart& other) { return other.name == part.name && other.detail == part.detail; });
  return found == frame.end() ? nullptr : &*found;
}

const DataArray* sameArray(const DataPart& part, const std::string& name) {
  const auto found = std::ranges::find(part.arrays, name, &DataArray::name);
  return found == part.arrays.end() ? nullptr : &*found;
}

double largestMagnitude(const Eigen::MatrixXd& values) {
  double largest = 0.0;
  for (const double value : values.reshaped())
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  return largest;
}

/// 0 for values that are the same, both not a number included; infinite if one alone is not finite.
double differenceBetween(double a, double b) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return 0.0;
  const double difference = std::abs(a - b);
  return std::isnan(difference) ? std::numeric_limits<double>::infinity() : difference;
}

std::string componentName(const DataArray& array, Eigen::Index component) {
  if (array.values.rows() == 1) return "";
  const auto k = static_cast<std::size_t>(component);
  return k < array.components.size() ? array.components[k] : std::to_string(component);
}

/// How many there are, and their names if they have any.
std::string componentsInWords(const DataArray& array) {
  if (array.components.empty()) return std::to_string(array.values.rows());
  return fmt::format("{} ({})", array.values.rows(), fmt::join(array.components, " "));
}

std::string numbersInWords(const Eigen::VectorXd& values) {
  std::vector<std::string> texts;
  for (const double value : values) texts.push_back(fmt::format("{:.6g}", value));
  return fmt::format("({})", fmt::join(texts, ", "));
}

std::string unitAfter(const std::string& unit) {
  return unit.empty() ? "" : " " + unit;
}

std::string unitInWords(const std::string& unit) {
  return unit.empty() ? "no unit" : "the unit " + unit;
}

std::string placeInWords(const WorstPlace& worst) {
  std::string words;
  if (worst.time) words = fmt::format("time {}", plainTime(*worst.time));
  if (!worst.place.empty()) {
    words += fmt::format("{}{} {}", words.empty() ? "" : ", ", worst.place, worst.number);
    if (!worst.owner.empty()) words += " of " + worst.owner;
    if (worst.position.size() > 0) words += " at " + numbersInWords(worst.position);
  }
  return words;
}

/// Compares two series field by field.
class SeriesComparison {
 public:
  SeriesComparison(const DataSeries& actual, const DataSeries& baseline, const DataRule& rule)
      : actual_(actual), baseline_(baseline), rule_(rule), matched_(matchTimes(actual, baseline)) {
    if (baseline.isTimed) names_.insert(baseline.name);
  }

  void findScales() {
    if (matched_.pairs.empty())
      for (const DataSeries* series : {&actual_, &baseline_})
        if (!series->times.empty()) noteAll(series->frame(0));
    for (const auto& [a, b] : matched_.pairs)
      for (const DataPart& part : baseline_.frame(b))
        for (const DataArray& array : part.arrays) {
          double& scale = scales_[withDetail(array.name, part)];
          scale = std::max(scale, largestMagnitude(array.values));
        }
  }

  void compareInstants() {
    for (const auto& [a, b] : matched_.pairs) {
      if (baseline_.isTimed) time_ = baseline_.times[b];
      compareFrames(actual_.frame(a), baseline_.frame(b));
    }
  }

  std::vector<FieldComparison> results() {
    std::vector<FieldComparison> all;
    if (areTimesCompared()) all.push_back(comparedTimes(baseline_.name, matched_));
    for (Field& field : fields_) {
      if (field.result.message.empty()) field.result.message = valuesInWords(field);
      all.push_back(std::move(field.result));
    }
    return all;
  }

  /// Names of all fields there are, and of the times.
  const std::set<std::string>& names() const { return names_; }

 private:
  struct Field {
    FieldComparison result;
    std::string unit;
    long long notANumber = 0;  ///< values that are numbers on one side alone
  };

  /// With whatever is compared, unless they are skipped; without a common time nothing else tells of it.
  bool areTimesCompared() const {
    if (!baseline_.isTimed) return false;
    if (matched_.pairs.empty())
      return std::ranges::any_of(
          names_, [&](const std::string& name) { return name != baseline_.name && isCompared(rule_, name); });
    return !fields_.empty() && isCompared({{}, {}, {}, rule_.skip}, baseline_.name);
  }

  void noteAll(const DataFrame& frame) {
    for (const DataPart& part : frame)
      for (const DataArray& array : part.arrays) names_.insert(array.name);
  }

  Field& fieldOf(const std::string& name) {
    const auto [place, isNew] = numbers_.try_emplace(name, fields_.size());
    if (isNew) fields_.emplace_back().result.name = name;
    return fields_[place->second];
  }

  std::string atTime() const { return time_ ? fmt::format(" at time {}", plainTime(*time_)) : ""; }

  /// The first finding of a kind that allows no comparison of values stays.
  void state(const std::string& name, FieldVerdict verdict, const std::string& message) {
    FieldComparison& result = fieldOf(name).result;
    if (!result.message.empty()) return;
    result.verdict = verdict;
    result.message = message;
  }

  void stateMissing(const std::string& name) {
    state(name, FieldVerdict::NoActual, fmt::format("missing{}: the baseline has it", atTime()));
  }

  void stateAdded(const std::string& name) {
    state(name, FieldVerdict::NoBaseline, fmt::format("no baseline{}: it has nothing of the name", atTime()));
  }

  std::vector<const DataArray*> wantedArrays(const DataPart& part) const {
    std::vector<const DataArray*> arrays;
    for (const DataArray& array : part.arrays)
      if (isCompared(rule_, array.name)) arrays.push_back(&array);
    return arrays;
  }

  void compareFrames(const DataFrame& actual, const DataFrame& baseline) {
    noteAll(baseline);
    noteAll(actual);
    for (const DataPart& part : baseline) {
      const DataPart* other = samePart(actual, part);
      if (other)
        compareParts(*other, part);
      else
        for (const DataArray* array : wantedArrays(part)) stateMissing(withDetail(array->name, part));
    }
    for (const DataPart& part : actual)
      if (!samePart(baseline, part))
        for (const DataArray* array : wantedArrays(part)) stateAdded(withDetail(array->name, part));
  }

  void compareParts(const DataPart& actual, const DataPart& baseline) {
    const std::vector<const DataArray*> expected = wantedArrays(baseline), found = wantedArrays(actual);
    if (expected.empty() && found.empty()) return;
    const bool isSame = haveSamePlaces(actual, baseline);
    for (const DataArray* array : expected) {
      const DataArray* other = sameArray(actual, array->name);
      if (!other)
        stateMissing(withDetail(array->name, baseline));
      else if (isSame)
        compareArrays(*other, *array, baseline);
    }
    for (const DataArray* array : found)
      if (!sameArray(baseline, array->name)) stateAdded(withDetail(array->name, actual));
  }

  bool haveSamePlaces(const DataPart& actual, const DataPart& baseline) {
    const std::string name = withDetail(baseline.name, baseline);
    if (actual.structure != baseline.structure) {
      if (structures_.insert(actual.structure + baseline.structure).second)
        state(name, FieldVerdict::MeshesDiffer,
              fmt::format("meshes differ{}: found {}; the baseline has {}; nothing on it is compared",
                          atTime(), actual.structure, baseline.structure));
      return false;
    }
    if (actual.numPlaces == baseline.numPlaces) return true;
    state(name, FieldVerdict::SizesDiffer,
          fmt::format("sizes differ{}: found {} {}s; the baseline has {}; nothing at them is compared",
                      atTime(), actual.numPlaces, baseline.place, baseline.numPlaces));
    return false;
  }

  void compareArrays(const DataArray& actual, const DataArray& baseline, const DataPart& part) {
    const std::string name = withDetail(baseline.name, part);
    if (actual.unit != baseline.unit)
      return state(name, FieldVerdict::UnitsDiffer,
                   fmt::format("units differ: found {}; the baseline has {}", unitInWords(actual.unit),
                               unitInWords(baseline.unit)));
    if (actual.values.rows() != baseline.values.rows() || actual.components != baseline.components)
      return state(name, FieldVerdict::ComponentsDiffer,
                   fmt::format("components differ{}: found {}; the baseline has {}", atTime(),
                               componentsInWords(actual), componentsInWords(baseline)));
    if (actual.values.cols() != baseline.values.cols())
      return state(name, FieldVerdict::SizesDiffer,
                   fmt::format("sizes differ{}: found {} values; the baseline has {}", atTime(),
                               actual.values.cols(), baseline.values.cols()));
    compareValues(actual, baseline, part, fieldOf(name));
  }

  void compareValues(const DataArray& actual, const DataArray& baseline, const DataPart& part, Field& field) {
    const Tolerance tolerance = baseline.isExact ? Tolerance{0.0, 0.0} : toleranceOf(rule_, baseline.name);
    FieldComparison& result = field.result;
    field.unit = baseline.unit;
    result.array = baseline.name;
    result.allowed = std::max(tolerance.absolute, tolerance.relative * scales_.at(result.name));
    for (Eigen::Index place = 0; place < baseline.values.cols(); ++place)
      for (Eigen::Index k = 0; k < baseline.values.rows(); ++k) {
        const double a = actual.values(k, place), b = baseline.values(k, place);
        const double difference = differenceBetween(a, b);
        ++result.compared;
        if (difference > result.allowed) ++result.differing;
        if (std::isnan(a) != std::isnan(b)) ++field.notANumber;
        if (difference > (result.worst ? result.worst->difference : 0.0))
          result.worst = worstAt(part, place, componentName(baseline, k), {a, b, difference});
      }
  }

  WorstPlace worstAt(const DataPart& part, Eigen::Index place, const std::string& component,
                     const std::array<double, 3>& values) const {
    WorstPlace worst{time_, component, part.place, place, "", {}, values[0], values[1], values[2]};
    if (!part.ownerOf.empty())
      worst.owner = part.owners[static_cast<std::size_t>(part.ownerOf[static_cast<std::size_t>(place)])];
    if (part.positions.size() > 0) worst.position = part.positions.col(place);
    return worst;
  }

  static std::string valuesInWords(Field& field) {
    FieldComparison& result = field.result;
    if (!result.worst || result.worst->difference <= result.allowed)
      return fmt::format("equal (largest difference {:.3g}, allowed {:.3g}{})",
                         result.worst ? result.worst->difference : 0.0, result.allowed,
                         unitAfter(field.unit));
    const WorstPlace& worst = *result.worst;
    result.verdict = std::isnan(worst.actual) != std::isnan(worst.baseline) ? FieldVerdict::NotANumber
                                                                            : FieldVerdict::Different;
    const bool isNumber = result.verdict == FieldVerdict::Different;
    const auto beyond = [&](long long count) {
      return fmt::format("{} of {} values by more than {:.3g}{}", count, result.compared, result.allowed,
                         unitAfter(field.unit));
    };
    const long long others = result.differing - field.notANumber;
    std::string extent = "different: " + beyond(result.differing) + "; worst";
    if (!isNumber)
      extent = fmt::format("not a number on one side: {} of {} values{}; the first", field.notANumber,
                           result.compared, others == 0 ? "" : "; different: " + beyond(others));
    const std::string where = placeInWords(worst);
    return fmt::format("{}{}{}: {}found {}, the baseline has {}{}", extent, where.empty() ? "" : " at ",
                       where, worst.component.empty() ? "" : worst.component + ": ", worst.actual,
                       worst.baseline, unitAfter(field.unit));
  }

  const DataSeries& actual_;
  const DataSeries& baseline_;
  const DataRule& rule_;
  MatchedTimes matched_;
  std::optional<double> time_;
  std::map<std::string, double> scales_;        ///< largest magnitudes in the baseline
  std::vector<Field> fields_;                   ///< in the order in which they were met
  std::map<std::string, std::size_t> numbers_;  ///< of the fields, by name
  std::set<std::string> names_;
  std::set<std::string> structures_;  ///< that differ and have been told of
};

}  // namespace

std::string verdictName(FieldVerdict verdict) {
  static const std::map<FieldVerdict, std::string> names{
      {FieldVerdict::Equal, "equal"},
      {FieldVerdict::Different, "different"},
      {FieldVerdict::NotANumber, "not-a-number"},
      {FieldVerdict::UnitsDiffer, "units-differ"},
      {FieldVerdict::ComponentsDiffer, "components-differ"},
      {FieldVerdict::SizesDiffer, "sizes-differ"},
      {FieldVerdict::MeshesDiffer, "meshes-differ"},
      {FieldVerdict::TimesDiffer, "times-differ"},
      {FieldVerdict::NoBaseline, "no-baseline"},
      {FieldVerdict::NoActual, "no-actual"},
      {FieldVerdict::Unusable, "unusable"}};
  return names.at(verdict);
}

std::vector<FieldComparison> compareSeries(const DataSeries& actual, const DataSeries& baseline,
                                           const DataRule& rule, std::vector<std::string>& names) {
  SeriesComparison comparison(actual, baseline, rule);
  comparison.findScales();
  comparison.compareInstants();
  std::vector<FieldComparison> results = comparison.results();
  names.insert(names.end(), comparison.names().begin(), comparison.names().end());
  return results;
}

}  // namespace burnish
