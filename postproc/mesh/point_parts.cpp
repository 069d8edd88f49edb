#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <vector>

#include "postproc/mesh/frame_parts.h"
#include "postproc/mesh/index_box.h"
#include "postproc/mesh/patch_geometry.h"
#include "postproc/mesh/poly_builder.h"
#include "postproc/mesh/vtk_arrays.h"

namespace burnish {
namespace {

/// Lines along every direction through the control points of a patch.
template <int Dim>
void addNet(const Patch<Dim>& patch, PolyBuilder& builder) {
  IndexBox box;
  for (int d = 0; d < Dim; ++d)
    box.extent[static_cast<std::size_t>(d)] = patch.basis().direction(d).numFunctions();
  const std::vector<vtkIdType> ids = builder.addPoints(patch.points());
  for (std::size_t along = 0; along < std::size_t{Dim}; ++along) {
    IndexBox starts = box;
    starts.extent[along] = 1;
    for (int start = 0; start < starts.size(); ++start) {
      auto index = starts.index(start);
      std::vector<vtkIdType> line;
      for (; index[along] < box.extent[along]; ++index[along])
        line.push_back(ids[static_cast<std::size_t>(box.number(index))]);
      builder.addLine(line);
    }
  }
}

std::vector<int> contactStatus(const ModelRecord& model, const FrameRecord& frame) {
  std::vector<int> status(static_cast<std::size_t>(meshOf(model, frame).numNodes), 0);
  for (const ContactRecord& contact : frame.contact)
    for (std::size_t a = 0; a < contact.nodes.size(); ++a)
      if (contact.active[a] == 1) status[static_cast<std::size_t>(contact.nodes[a])] = 1;
  return status;
}

}  // namespace

vtkSmartPointer<vtkPolyData> quadraturePoints(const FrameRecord& frame) {
  const QuadratureRecord& record = frame.quadrature;
  const auto cloud = vtkSmartPointer<vtkPolyData>::New();
  cloud->SetPoints(makePoints(record.positions));
  vtkNew<vtkCellArray> vertices;
  for (vtkIdType point = 0; point < record.positions.cols(); ++point) vertices->InsertNextCell(1, &point);
  cloud->SetVerts(vertices);
  for (const auto& [name, field] : record.fields)
    cloud->GetPointData()->AddArray(makeArray(labelled(name, field.unit), field.values, field.components));
  return cloud;
}

vtkSmartPointer<vtkPolyData> controlNet(const ModelRecord& model, const FrameRecord& frame) {
  PolyBuilder builder;
  std::vector<int> nodes;
  std::vector<double> weights;
  for (const PatchRecord& patch : meshOf(model, frame).patches) {
    if (model.dim == 2)
      addNet(patchGeometry<2>(patch, frame.displacement), builder);
    else
      addNet(patchGeometry<3>(patch, frame.displacement), builder);
    nodes.insert(nodes.end(), patch.nodes.begin(), patch.nodes.end());
    weights.insert(weights.end(), patch.weights.begin(), patch.weights.end());
  }
  const std::vector<int> statusOfNode = contactStatus(model, frame);
  std::vector<int> status;
  for (const int node : nodes) status.push_back(statusOfNode[static_cast<std::size_t>(node)]);

  const auto net = builder.finish();
  vtkPointData& data = *net->GetPointData();
  const Eigen::MatrixXd u = frame.displacement(Eigen::all, nodes);
  data.AddArray(makeArray(labelled("displacement", model.lengthUnit), inSpace(u), kAxes));
  data.AddArray(makeArray(
      "weight",
      Eigen::Map<const Eigen::RowVectorXd>(weights.data(), static_cast<Eigen::Index>(weights.size())), {}));
  data.AddArray(makeIntegers("node", nodes));
  data.AddArray(makeIntegers("in_contact", status));
  return net;
}

}  // namespace burnish
