#include "engine/analysis/state_quantities.h"

#include <fmt/format.h>

#include <algorithm>

namespace burnish::inline analysis {

void RezoningSums::add(const RezoningRecord& rezoning) {
  ++count;
  energyLost += rezoning.energyLost;
  gapWork += rezoning.gapWork;
  volumeDrift = rezoning.volumeDrift;
  boundaryError = std::max(boundaryError, rezoning.boundaryError);
}

double StateQuantities::frictionWork() const {
  double work = selfTouch.frictionWork;
  for (const ToolTouch& touch : toolTouches) work += touch.frictionWork;
  for (const PairTouch& pair : pairs) work += pair.frictionWork;
  return work;
}

void StateQuantities::archive(StateArchive& archive) {
  archive.field("time", time);
  for (std::size_t k = 0; k < toolPoses.size(); ++k) {
    const std::string name = fmt::format("tool{}_", k);
    archive.field(name + "displacement", toolPoses[k].displacement);
    archive.field(name + "angle", toolPoses[k].angle);
    archive.field(name + "spin", toolPoses[k].spin);
    archive.field(name + "force", toolForces[k]);
    archive.field(name + "moment", toolMoments[k]);
    ToolTouch& touch = toolTouches[k];
    archive.together(name + "touch", touch.area, touch.friction, touch.sticking, touch.slipping,
                     touch.frictionWork);
  }
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    PairTouch& pair = pairs[k];
    archive.field(fmt::format("pair{}_force", k), pair.force);
    archive.together(fmt::format("pair{}", k), pair.pressed, pair.friction, pair.active, pair.sticking,
                     pair.slipping, pair.penetration, pair.frictionWork);
  }
  for (std::size_t k = 0; k < bodies.size(); ++k)
    archive.together(fmt::format("body{}", k), bodies[k].strainEnergy, bodies[k].plasticWork,
                     bodies[k].maxPlasticStrain, bodies[k].minJ, bodies[k].crossesItself);
  archive.together("energies", strainEnergy, contactEnergy, externalWork, plasticWork, stabilisationWork,
                   largestEnergy);
  archive.together("plastic_strain", maxPlasticStrain, projectedPlasticStrain.min,
                   projectedPlasticStrain.max);
  archive.together("contact", activeControlPoints, maxPenetration, selfActiveControlPoints,
                   maxSelfPenetration, selfForce, crossesItself);
  archive.together("self_friction", selfTouch.friction, selfTouch.sticking, selfTouch.slipping,
                   selfTouch.frictionWork);
  archive.together("bounds", minJ, stabilisedShare);
  archive.together("rezonings", rezonings.count, rezonings.energyLost, rezonings.gapWork,
                   rezonings.volumeDrift, rezonings.boundaryError);
  archive.fixedField("reactions", reactions);
  archive.fixedField("measured", measured);
}

}  // namespace burnish::inline analysis
