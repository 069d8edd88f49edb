#pragma once
#include <vtkPointData.h>
#include <vtkSmartPointer.h>

#include <array>
#include <optional>
#include <vector>

#include "postproc/draw/contour/contour_parts.h"
#include "postproc/mesh/tessellation.h"
#include "postproc/mesh/vtk_arrays.h"

class vtkDataSet;
class vtkPolyData;
class vtkUnstructuredGrid;

/// Parts of bodies that are chosen by the values of a field: where it lies between two, and where it has some.
namespace burnish {

/// Point data: the values by which parts are chosen.
inline constexpr const char* kChosen = "chosen";

/// Where an array of the points has these values: surfaces in volumes, lines on surfaces, with the point data there, of which
/// `drawn` are the scalars.
vtkSmartPointer<vtkPolyData> levelsOf(vtkDataSet& cells, const char* array,
                                      const std::vector<double>& values);

/// The field of a threshold or of surfaces, whichever the options have: the drawn one, or that of their name. Throws
/// `Error` for one that is not in the frame, or not in a body that is drawn.
FieldChoice choosingField(const ModelRecord& model, const FrameRecord& frame, const FieldChoice& drawn,
                          const ContourOptions& options);

/// What a picture says of a choice; empty without one. range: of the colours; none of a field of one value.
std::string choiceNote(const ContourOptions& options, const FieldChoice& choosing,
                       const std::optional<std::array<double, 2>>& range);

/// What is to be said of a choice that leaves nothing of the bodies, whose values go over a range. drawn: the drawn field.
std::string nothingChosen(const ContourOptions& options, const FieldChoice& drawn,
                          const std::optional<double>& time, const std::array<double, 2>& range);

/// Gives points `kChosen`. mesh: knows how to evaluate there.
template <class Mesh>
void setChosen(vtkPointData& points, const Mesh& mesh, const FieldChoice& choosing) {
  points.AddArray(
      makeArray(kChosen, choosing.drawnScalars(mesh.evaluate(choosing.coefficients)).transpose(), {}));
}

/// Leaves of a plane body where `kChosen` lies between the ends; its edges become those of this part, and what they
/// were `ghostOutline`. The lines of the parts have the values as `kValuesAlong`.
void keepBetween(ContourParts& parts, const std::array<double, 2>& ends, const FieldChoice& choosing);

/// A body in space cut into hexahedra, with the values of two fields.
class ValueVolume {
 public:
  using Ends = std::array<double, 2>;

  /// perSpan: cells per knot span and direction. displacement: dim x nodes. Throws `Error` as `Tessellation`.
  ValueVolume(const MeshRecord& mesh, const Eigen::MatrixXd& displacement, int perSpan,
              const FieldChoice& drawn, const FieldChoice& choosing);

  /// Where the choosing field has these values, within the accuracy of linear interpolation in the cells; the scalars
  /// are those of the drawn field. The normals are the field's gradient, downwards.
  vtkSmartPointer<vtkPolyData> surfacesAt(const std::vector<double>& values) const;

  /// The closed surface of the part between the ends, with outward normals.
  vtkSmartPointer<vtkPolyData> surfaceBetween(const Ends& ends) const;

  /// The part of a section between the ends.
  vtkSmartPointer<vtkPolyData> sectionBetween(const CutPlane& plane, const Ends& ends) const;

  /// The surfaces inside at finite ends alone, outwards of what lies between.
  vtkSmartPointer<vtkPolyData> capsAt(const Ends& ends) const;

  /// The faces between and around knot spans, with the values.
  vtkSmartPointer<vtkPolyData> spanFaces() const;

 private:
  vtkSmartPointer<vtkPolyData> surfaceAt(const std::vector<double>& values, double sign) const;

  /// The faces that can be seen, with normals and values.
  vtkSmartPointer<vtkPolyData> faces() const;

  /// Gives points both values.
  template <class Mesh>
  void setValues(vtkPointData& points, const Mesh& mesh) const;

  const MeshRecord& mesh_;
  const Eigen::MatrixXd& displacement_;
  int perSpan_;
  const FieldChoice &drawn_, &choosing_;
  vtkSmartPointer<vtkUnstructuredGrid> grid_;
};

/// Cells per knot span and direction, at which linear interpolation in a body in space is off by less than a thousandth
/// of the field's range and a four-thousandth of the body's size, as far as 16 cells per span and 1.5 million in all
/// allow; never fewer than `least` but for these.
int volumeSubdivision(const MeshRecord& mesh, const Eigen::MatrixXd& displacement, const FieldChoice& field,
                      int least);

/// Replaces a body in space by what its options choose. The body becomes `ghost`, its edges `ghostOutline`. field: the
/// drawn one. range: of its colours, unless it has one value.
void chooseInSpace(ContourParts& parts, const ModelRecord& model, const FrameRecord& frame,
                   const FieldChoice& field, const ContourOptions& options,
                   const std::optional<std::array<double, 2>>& range);

}  // namespace burnish
