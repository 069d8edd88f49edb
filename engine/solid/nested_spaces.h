#pragma once
#include <Eigen/Sparse>
#include <array>
#include <vector>

#include "engine/nurbs/coarsening.h"
#include "engine/solid/body.h"

namespace burnish::inline solid {

/// A body's displacement space on fewer and fewer knot spans. Every space lies in the one before it, so that
/// knot insertion is its exact prolongation P of control points' displacements:
///
///     R_i = w_i N_i / W(ξ)        P = diag(w)⁻¹ T diag(W_c)
///
/// with T = T₁ ⊗ T₂ ⊗ T₃ of the splines and W_c the weights of the coarse functions: w = T W_c where the weight
/// function lies in the coarse space, else those that come nearest to it (least squares).
template <int Dim>
class NestedSpaces {
 public:
  using Prolongation = Eigen::SparseMatrix<double, Eigen::RowMajor>;

  /// Begins with the body's own space. Of several bodies, numbered together, each becomes coarser by itself.
  /// The body must outlive the object.
  explicit NestedSpaces(const Body<Dim>& body);

  /// Goes to the next coarser space; false if no spans can be merged.
  bool coarsen(const MergeRule& rule);

  int numNodes() const { return numNodes_; }

  /// Coefficients in the space before the last one from those in the last one, nodes x nodes.
  const Prolongation& prolongation() const { return prolongation_; }

  /// Components of the last space that are held, Dim flags per node, from those of the space before: a
  /// function on a face is held if all functions of this face that it is made of are.
  std::vector<bool> held(const std::vector<bool>& finer) const;

  /// The last space on one of the patches: its basis and weights.
  const TensorBasis<Dim>& basis(std::size_t patch) const { return patches_[patch].basis; }
  const Eigen::VectorXd& weights(std::size_t patch) const { return patches_[patch].weights; }
  const std::vector<int>& nodes(std::size_t patch) const { return patches_[patch].nodes; }

 private:
  struct PatchSpace {
    TensorBasis<Dim> basis;
    Eigen::VectorXd weights;
    std::vector<int> nodes;
  };

  /// Directions of patches that are divided alike because the patches meet.
  struct Strip {
    struct Member {
      std::size_t patch;
      int direction;
      bool reversed;
    };
    std::vector<Member> members;
    int body = 0;          ///< number of the group of patches that hang together
    bool isFixed = false;  ///< a joint turns it round onto itself
  };

  using Transfers = std::array<Prolongation, Dim>;

  void findStrips();
  std::vector<double> lengths(const Strip& strip) const;
  std::vector<double> lengths(const typename Strip::Member& member) const;
  static Eigen::VectorXd coarseWeights(const Eigen::VectorXd& fine, const Transfers& T);
  void numberNodes();
  void makeProlongation(int numFiner);

  /// Calls f(coarse function, coefficient) for all functions of the last space in a function of a patch of the
  /// space before.
  template <class F>
  void forEachCoarse(std::size_t patch, const typename TensorBasis<Dim>::Index& fine, const F& f) const;

  const Body<Dim>& body_;
  std::vector<Strip> strips_;
  int numBodies_ = 0;
  std::vector<int> bodyOf_;  ///< per patch
  std::vector<PatchSpace> finer_, patches_;
  std::vector<Transfers> transfers_;  ///< per patch: T of each direction in the last step
  int numNodes_ = 0;
  Prolongation prolongation_;
};

}  // namespace burnish::inline solid
