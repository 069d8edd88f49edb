#pragma once
#include <array>
#include <limits>
#include <string>
#include <vector>

#include "engine/results/result_reader.h"
#include "postproc/probe/probe_spec.h"
#include "postproc/text/units.h"

namespace burnish {

/// What a depth profile says as a whole: whether the section is in balance, what is left and how deep. σ is the stress
/// along the face, across the profile: in the plane, and in space in the first direction of the face; the stress across
/// both is out of the plane, round the axis, and in space in the other direction of the face. What a body does not
/// have is not a number (kNone): stresses of files without them, the balance of sections that are not those of plane
/// strain, and the hardened depth without plastic strain. Forces are per unit of depth.
struct DepthNumbers {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  /// A stress over the depth.
  struct Profile {
    double atFace = kNone;    ///< at the face
    double lowest = kNone;    ///< the smallest
    double lowestAt = kNone;  ///< the depth of it
    double compressedDepth =
        kNone;  ///< where it is zero first below its smallest value; 0 if that is no compression
  };

  double depth = 0.0;      ///< h, of the profile: of the whole section where it goes to the other face
  double force = kNone;    ///< N = ∫ σ dz, in plane strain
  double moment = kNone;   ///< M = ∫ σ (h/2 - z) dz, positive with tension at the face
  double balance = kNone;  ///< |N| / (h max|σ|)
  double unsteadiness =
      kNone;  ///< max(|stress of the profile's direction|, |shear|) / max|σ|: 0 where nothing changes along the face
  Profile along, across;
  double hardenedDepth = kNone;  ///< where the plastic strain falls below the limit of the spec for good
};

/// What a number is measured in.
enum class DepthUnit { Length, Stress, Force, Moment, None };

struct DepthNumberRow {
  const char* name;
  double (*value)(const DepthNumbers& numbers);
  DepthUnit unit;
};

/// All of them, in the order of tables.
inline constexpr std::array<DepthNumberRow, 14> kDepthNumbers{{
    {"depth", [](const DepthNumbers& n) { return n.depth; }, DepthUnit::Length},
    {"force", [](const DepthNumbers& n) { return n.force; }, DepthUnit::Force},
    {"moment", [](const DepthNumbers& n) { return n.moment; }, DepthUnit::Moment},
    {"balance", [](const DepthNumbers& n) { return n.balance; }, DepthUnit::None},
    {"unsteadiness", [](const DepthNumbers& n) { return n.unsteadiness; }, DepthUnit::None},
    {"at_face", [](const DepthNumbers& n) { return n.along.atFace; }, DepthUnit::Stress},
    {"lowest", [](const DepthNumbers& n) { return n.along.lowest; }, DepthUnit::Stress},
    {"lowest_at", [](const DepthNumbers& n) { return n.along.lowestAt; }, DepthUnit::Length},
    {"compressed_depth", [](const DepthNumbers& n) { return n.along.compressedDepth; }, DepthUnit::Length},
    {"hardened_depth", [](const DepthNumbers& n) { return n.hardenedDepth; }, DepthUnit::Length},
    {"across_at_face", [](const DepthNumbers& n) { return n.across.atFace; }, DepthUnit::Stress},
    {"across_lowest", [](const DepthNumbers& n) { return n.across.lowest; }, DepthUnit::Stress},
    {"across_lowest_at", [](const DepthNumbers& n) { return n.across.lowestAt; }, DepthUnit::Length},
    {"across_compressed_depth", [](const DepthNumbers& n) { return n.across.compressedDepth; },
     DepthUnit::Length},
}};

/// The names of `kDepthNumbers`.
std::vector<std::string> depthNumberNames();

/// The numbers of the profile that a spec with `depth` names, in the deformed body, from its points. Throws `Error` for
/// a spec without `depth` or with `reference`, and for a place that the body does not have.
DepthNumbers depthNumbers(const ModelRecord& model, const FrameRecord& frame, const ProbeSpec& spec);

/// Whether a spec is that of a profile which has numbers.
bool hasDepthNumbers(const ProbeSpec& spec);

/// The numbers of an instant of a run.
struct DepthNumbersAt {
  std::string run;  ///< empty for the only one
  double time = 0.0;
  DepthNumbers numbers;
};

/// Of all frames of these times, the last one if there is none. Throws `Error` as above, and for a time without a
/// frame.
std::vector<DepthNumbersAt> depthNumbersOf(const ResultReader& result, const ProbeSpec& spec,
                                           const std::vector<double>& times);

/// As CSV: the run where one has a name, the time, and the numbers with their units.
std::string tableOf(const std::vector<DepthNumbersAt>& rows, const DerivedUnits& units,
                    const std::string& stressUnit);

}  // namespace burnish
