#pragma once
#include <memory>
#include <optional>

#include "engine/solver/compact_matrix.h"
#include "engine/solver/incomplete_factors.h"
#include "engine/solver/petsc/matrix_blocks.h"

namespace burnish::inline solver {

/// What smooths on a level: products and incomplete factors of the level's matrix by rows of nodes, in single precision,
/// which the library does not have and takes a multiple of the time for. Each of several ranks has factors of its diagonal
/// block, of the rows next to these as well where they overlap; off-diagonal blocks are the library's.
class LevelSmoother {
 public:
  /// For matrices of the pattern of A; groups, of its diagonal block, have to stay. All ranks make one together, and assign together.
  LevelSmoother(Mat A, const RowGroups& groups, bool overlaps);
  LevelSmoother(const LevelSmoother&) = delete;
  LevelSmoother& operator=(const LevelSmoother&) = delete;

  /// False if this rank has no factors. What is kept of A is a copy. leastShift: see `IncompleteFactors`.
  bool assign(Mat A, double leastShift);

  /// Of this rank's factors. The eigenvalues that they leave depend on it.
  double shift() const { return factors_.shift(); }

  /// To multiply by.
  Mat product() const { return product_; }

  /// Makes a preconditioner the factors' solution.
  void attachTo(PC preconditioner);

 private:
  /// This rank's rows and columns, and those that they are coupled with.
  class Overlap {
   public:
    explicit Overlap(Mat A);
    ~Overlap();
    Overlap(const Overlap&) = delete;
    Overlap& operator=(const Overlap&) = delete;

    SparseRows assign(Mat A);
    const RowGroups& groups() const { return *groups_; }

    /// x = the sum over ranks of what f(from, to) makes of their numbers of b.
    template <class F>
    void apply(Vec b, Vec x, const F& f);

   private:
    petsc::Indices rows_;
    Mat* matrix_ = nullptr;  ///< the library's array of one
    std::optional<RowGroups> groups_;
    petsc::Vector in_, out_;
    petsc::Scatter scatter_;  ///< to them
  };

  void multiply(Vec x, Vec y);
  void solve(Vec b, Vec x) const;

  CompactMatrix diagonal_;
  std::unique_ptr<Overlap> overlap_;  ///< of several ranks
  IncompleteFactors factors_;
  petsc::Matrix offDiagonal_;
  std::optional<petsc::GhostValues> ghosts_;
  petsc::Matrix product_;
};

}  // namespace burnish::inline solver
