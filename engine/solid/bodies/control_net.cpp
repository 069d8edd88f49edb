#include "engine/solid/bodies/control_net.h"

namespace burnish {

void check(const ControlNetBody& net, const Problems& problems) {
  checkNet(net, problems, "", {net.degrees.size(), net.degrees.size()}, "the body");
}

}  // namespace burnish
