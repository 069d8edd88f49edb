#pragma once
#include <memory>
#include <vector>

#include "engine/contact/carried_frame.h"
#include "engine/contact/partner.h"
#include "engine/contact/tool_passage.h"

namespace burnish::inline contact {

/// A rigid tool as the partner of a face. Its motion is prescribed, or free in some degrees of freedom, which
/// are the partner's unknowns.
///
/// Gap: ∂g = n · (δx - w), with the velocity w of the tool's matter at x, and ∂²g as `ToolGap` has it. The
/// foot of a point in the accepted state, x_n - g_n n_n, moves with the tool to y; with v = x - y the slip of
/// the step is s = (I - n⊗n) v, its derivative ∂(e_α·s) = e_α·(δx - w(y)) + v·δe_α; the force of friction
/// acts on the tool at x and does work on δs_T = (I - n⊗n)(δx - w(x)). In the plane e = (n_y, -n_x); in space
/// two unit vectors E_α across a mean normal n_0 are carried to n by the smallest rotation,
///
///     e_α = E_α - (n·E_α)/(1 + n_0·n) (n_0 + n).
///
/// A ball that spins turns within a step by the rotation vector θ; then w(y) = J(θ) δθ × (y - c) (`turned`), and
/// w(x) = δψ × (x - c) with the turns δψ about x, y and z, whose equations say that no moment about c is left.
template <int Dim>
class ToolPartner final : public Partner<Dim> {
 public:
  /// The tool must outlive the object.
  explicit ToolPartner(const Tool& tool);

  [[nodiscard]] bool update(double t, const Eigen::VectorXd& x, const Eigen::MatrixXd& positions) override;
  std::optional<ContactPoint<Dim>> at(const SlavePoint<Dim>& point, PointDetail detail) const override;
  void addSlip(const SlavePoint<Dim>& point, ContactPoint<Dim>& contact) const override;
  Eigen::MatrixXd frictionTangent(const SlavePoint<Dim>& point, const ContactPoint<Dim>& contact,
                                  const Eigen::Vector<double, Dim - 1>& traction) const override;
  std::vector<int> couplings(std::size_t) const override { return tool_.freeUnknowns(); }
  std::vector<int> freeTurns() const override;
  Eigen::Vector3d pivot() const override { return tool_.pivot + pose_.displacement; }
  double prescribedWork(const Eigen::Vector3d& force, const Eigen::Vector3d& moment) const override;
  void accept() override;
  void archive(StateArchive& archive) override;

 private:
  using Vector = Eigen::Vector<double, Dim>;
  using Rows = Eigen::Matrix<double, Dim, Eigen::Dynamic>;  ///< of a vector: by the unknowns
  using Frame = Eigen::Matrix<double, Dim, Dim - 1>;

  ToolGap query(const Eigen::Vector3d& x) const;
  const ToolGap& queryAt(const SlavePoint<Dim>& point, ToolGap& storage) const;

  /// Where the matter of the tool is now that was the foot of a point in the accepted state.
  Eigen::Vector3d movedFoot(const SlavePoint<Dim>& point) const;

  /// Turn of a ball that spins since the accepted state.
  TurnByVector spun() const { return turned(pose_.spin - acceptedPose_.spin); }

  /// δx - w(y): the way of a point of the face less that of the tool's matter at y. spin: turns of a ball by the
  /// unknowns of its spin.
  Rows relativeMotion(const SlavePoint<Dim>& point, const Eigen::Vector3d& y,
                      const Eigen::Matrix3d& spin) const;

  /// δn.
  Rows normalMotion(const SlavePoint<Dim>& point) const;

  /// The unknowns of the spin, on which the gap does not depend.
  void addSpins(ContactPoint<Dim>& contact) const;

  /// A mean of the tool's normals, in which points near to it count most.
  Vector meanNormal() const;

  void chooseAccepted();

  const Tool& tool_;
  std::vector<std::size_t> dofs_;   ///< free ones that gaps depend on
  std::vector<std::size_t> spins_;  ///< free ones that slip alone depends on
  ToolPassage passage_;
  ToolPose pose_;
  std::vector<ToolGap> queries_;  ///< at the face's quadrature points

  // The accepted state, that of the first update before there is one.
  bool hasAccepted_ = false;
  ToolPose acceptedPose_;
  Vector n0_ = Vector::Zero();
  Frame E_ = Frame::Zero();
};

/// Makes a tool the partner of a face. The tool must outlive the partner.
template <int Dim>
PartnerMaker<Dim> onTool(const Tool& tool) {
  return [&tool](const FaceQuadrature<Dim>&) { return std::make_unique<ToolPartner<Dim>>(tool); };
}

}  // namespace burnish::inline contact
