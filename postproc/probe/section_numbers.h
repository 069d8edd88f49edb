#pragma once
#include <Eigen/Dense>
#include <array>
#include <limits>
#include <string>
#include <vector>

#include "engine/results/result_reader.h"
#include "postproc/mesh/picture_planes.h"
#include "postproc/text/units.h"

namespace burnish {

/// What one part of a body does to the other across a plane, from the Cauchy stress over the section: the part to which
/// the normal n points pulls at the other. Of a plane body per unit of depth; of a body of revolution of the whole ring.
struct SectionNumbers {
  double area = 0.0;                        ///< A, of a plane body a length
  double force = 0.0;                       ///< N = ∫ n·σn dA
  double tension = 0.0, compression = 0.0;  ///< ∫ max(n·σn, 0) dA and ∫ min(n·σn, 0) dA; N is their sum
  double largest = 0.0;                     ///< max |n·σn|
  Eigen::Vector3d traction = Eigen::Vector3d::Zero();  ///< ∫ σn dA
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();    ///< ∫ (x - c) × σn dA about the centroid c

  /// How much area, forces and moment have changed at last when spans were cut finer, as parts of the area, and of what the
  /// largest stress all over it would make; nan where they were cut once.
  double unsettled = std::numeric_limits<double>::quiet_NaN();

  /// |N| / (A max|n·σn|)
  double balance() const;
};

/// What a number is measured in.
enum class SectionUnit { Area, Force, Stress, Moment, None };

struct SectionNumberRow {
  const char* name;
  double (*value)(const SectionNumbers& numbers);
  SectionUnit unit;
};

/// All of them, in the order of tables.
inline constexpr std::array<SectionNumberRow, 13> kSectionNumbers{{
    {"area", [](const SectionNumbers& n) { return n.area; }, SectionUnit::Area},
    {"force", [](const SectionNumbers& n) { return n.force; }, SectionUnit::Force},
    {"tension", [](const SectionNumbers& n) { return n.tension; }, SectionUnit::Force},
    {"compression", [](const SectionNumbers& n) { return n.compression; }, SectionUnit::Force},
    {"largest", [](const SectionNumbers& n) { return n.largest; }, SectionUnit::Stress},
    {"balance", [](const SectionNumbers& n) { return n.balance(); }, SectionUnit::None},
    {"fx", [](const SectionNumbers& n) { return n.traction.x(); }, SectionUnit::Force},
    {"fy", [](const SectionNumbers& n) { return n.traction.y(); }, SectionUnit::Force},
    {"fz", [](const SectionNumbers& n) { return n.traction.z(); }, SectionUnit::Force},
    {"mx", [](const SectionNumbers& n) { return n.moment.x(); }, SectionUnit::Moment},
    {"my", [](const SectionNumbers& n) { return n.moment.y(); }, SectionUnit::Moment},
    {"mz", [](const SectionNumbers& n) { return n.moment.z(); }, SectionUnit::Moment},
    {"unsettled", [](const SectionNumbers& n) { return n.unsettled; }, SectionUnit::None},
}};

/// The names of `kSectionNumbers`.
std::vector<std::string> sectionNumberNames();

/// The numbers of the section of the deformed bodies of these names, of all without any. Knot spans are cut ever finer
/// until areas, forces and moments stay to 1e-5, but no finer than into 16 parts per direction in space, 64 in the plane.
/// Throws `Error` that begins with `section` for a frame without stresses, a plane that does not cut the bodies, and in
/// axisymmetry one that is not across the axis.
SectionNumbers sectionNumbers(const ModelRecord& model, const FrameRecord& frame, const CutPlane& plane,
                              const std::vector<std::string>& bodies);

/// The numbers of an instant of a run.
struct SectionNumbersAt {
  std::string run;  ///< empty for the only one
  double time = 0.0;
  SectionNumbers numbers;
};

/// As CSV: the run where one has a name, the time, and the numbers with their units.
std::string tableOf(const std::vector<SectionNumbersAt>& rows, const DerivedUnits& units,
                    const std::string& stressUnit);

}  // namespace burnish
