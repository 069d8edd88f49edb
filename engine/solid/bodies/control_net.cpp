#include "engine/solid/bodies/control_net.h"

namespace burnish::inline solid {

void check(const ControlNetBody& net, const Problems& problems) {
  checkNet(net, problems, "", {net.degrees.size(), net.degrees.size()}, "the body");
}

}  // namespace burnish::inline solid
