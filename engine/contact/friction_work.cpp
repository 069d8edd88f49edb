#include "engine/contact/friction_work.h"

namespace burnish::inline contact {

void FrictionWork::start(const Eigen::VectorXd& x) {
  if (accepted_.x.size() == 0) {
    accepted_.x = x;
    accepted_.force = Eigen::VectorXd::Zero(x.size());
  }
  trial_ = {};
  trial_.x = x;
  trial_.force = Eigen::VectorXd::Zero(x.size());
}

void FrictionWork::archive(StateArchive& archive) {
  archive.field("accepted_x", accepted_.x);
  archive.field("friction_force", accepted_.force);
  archive.field("friction_reaction", accepted_.reaction);
  archive.field("friction_moment", accepted_.moment);
  archive.field("friction_work", accepted_.work);
  if (archive.restores()) trial_ = accepted_;
}

}  // namespace burnish::inline contact
