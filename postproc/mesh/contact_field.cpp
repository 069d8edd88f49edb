#include "postproc/mesh/contact_field.h"

#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <array>

#include "postproc/mesh/contact_surface.h"
#include "postproc/mesh/frame_parts.h"
#include "postproc/mesh/plane_section.h"
#include "postproc/mesh/poly_builder.h"
#include "postproc/mesh/vtk_arrays.h"

namespace burnish {
namespace {

enum class UnitOf { Stress, Length, None };

/// A field, and the array of `contactSurface` whose amounts it shows.
struct ContactField {
  const char* name;
  const char* array;
  UnitOf unit;
  bool ofFriction;
  bool isVector;
};

constexpr std::array kFields{
    ContactField{"contact_pressure", "contact_pressure", UnitOf::Stress, false, false},
    ContactField{"friction_traction", "friction", UnitOf::Stress, true, true},
    ContactField{"slip", "slip", UnitOf::Length, true, true},
    ContactField{"slipped", "slipped", UnitOf::Length, true, false},
    ContactField{"sliding", "sliding", UnitOf::None, true, false}};

const ContactField* fieldNamed(const std::string& name) {
  const auto found =
      std::find_if(kFields.begin(), kFields.end(), [&](const ContactField& f) { return f.name == name; });
  return found == kFields.end() ? nullptr : found;
}

std::string unitOf(const ModelRecord& model, const ContactField& field) {
  switch (field.unit) {
    case UnitOf::Stress:
      return model.stressUnit;
    case UnitOf::Length:
      return model.lengthUnit;
    case UnitOf::None:
      break;
  }
  return "";
}

/// The surface with the amounts of one of its arrays alone.
void keepAmounts(vtkPolyData& surface, vtkDataArray& array) {
  Eigen::VectorXd amounts(array.GetNumberOfTuples());
  for (vtkIdType k = 0; k < array.GetNumberOfTuples(); ++k)
    amounts(k) = Eigen::Map<const Eigen::VectorXd>(array.GetTuple(k), array.GetNumberOfComponents()).norm();
  surface.GetPointData()->Initialize();
  surface.GetPointData()->SetScalars(makeArray("drawn", amounts.transpose(), {}));
}

/// Parts of lines and polygons, each with one value.
class Pieces {
 public:
  explicit Pieces(vtkPolyData& surface) : surface_(surface), values_(*surface.GetPointData()->GetScalars()) {
    for (vtkIdType cell = 0; cell < surface.GetNumberOfCells(); ++cell) {
      vtkNew<vtkIdList> list;
      surface.GetCellPoints(cell, list);
      const std::vector<vtkIdType> ids(list->begin(), list->end());
      const int type = surface.GetCellType(cell);
      type == VTK_LINE || type == VTK_POLY_LINE ? addLine(ids) : addPolygon(ids);
    }
  }

  vtkSmartPointer<vtkPolyData> finish() const {
    auto pieces = builder_.finish();
    const Eigen::Map<const Eigen::RowVectorXd> row(ofPieces_.data(), std::ssize(ofPieces_));
    pieces->GetPointData()->SetScalars(makeArray("drawn", row, {}));
    return pieces;
  }

 private:
  Eigen::Vector3d place(vtkIdType id) const {
    return Eigen::Map<const Eigen::Vector3d>(surface_.GetPoint(id));
  }
  Eigen::Vector3d between(vtkIdType one, vtkIdType other) const { return 0.5 * (place(one) + place(other)); }

  std::vector<vtkIdType> addPoints(const std::vector<Eigen::Vector3d>& points, double value) {
    Eigen::Matrix3Xd places(3, std::ssize(points));
    for (std::size_t k = 0; k < points.size(); ++k) places.col(static_cast<Eigen::Index>(k)) = points[k];
    ofPieces_.insert(ofPieces_.end(), points.size(), value);
    return builder_.addPoints(places);
  }

  /// One line as far as the value is the same.
  void addLine(const std::vector<vtkIdType>& ids) {
    std::vector<Eigen::Vector3d> points;
    for (std::size_t k = 0; k < ids.size(); ++k) {
      const double value = values_.GetTuple1(ids[k]);
      points.push_back(place(ids[k]));
      const bool isLast = k + 1 == ids.size();
      if (!isLast && values_.GetTuple1(ids[k + 1]) == value) continue;
      if (!isLast) points.push_back(between(ids[k], ids[k + 1]));
      builder_.addLine(addPoints(points, value));
      points.erase(points.begin(), points.end() - 1);
    }
  }

  /// For every corner the part that is nearest to it.
  void addPolygon(const std::vector<vtkIdType>& ids) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const vtkIdType id : ids) middle += place(id) / static_cast<double>(ids.size());
    for (std::size_t k = 0; k < ids.size(); ++k) {
      const vtkIdType here = ids[k], next = ids[(k + 1) % ids.size()],
                      before = ids[(k + ids.size() - 1) % ids.size()];
      builder_.addPolygon(addPoints({place(here), between(here, next), middle, between(before, here)},
                                    values_.GetTuple1(here)));
    }
  }

  vtkPolyData& surface_;
  vtkDataArray& values_;
  PolyBuilder builder_;
  std::vector<double> ofPieces_;  ///< per point
};

}  // namespace

std::vector<std::string> contactFieldNames() {
  std::vector<std::string> names;
  for (const ContactField& field : kFields) names.emplace_back(field.name);
  return names;
}

bool isContactField(const std::string& name) {
  return fieldNamed(name) != nullptr;
}

bool isOfFriction(const std::string& name) {
  const ContactField* field = fieldNamed(name);
  return field != nullptr && field->ofFriction;
}

std::vector<std::string> contactFieldsOf(const FrameRecord& frame) {
  const bool rubs = std::any_of(frame.contact.begin(), frame.contact.end(),
                                [](const ContactRecord& c) { return !c.quadratureSliding.empty(); });
  std::vector<std::string> names;
  for (const ContactField& field : kFields)
    if (field.ofFriction ? rubs : !frame.contact.empty()) names.emplace_back(field.name);
  return names;
}

std::vector<std::string> statesOfContactField(const std::string& name) {
  if (name != "sliding") return {};
  return {"open", "stick", "slip"};
}

ContactArray arrayOfContactField(const std::string& name) {
  const ContactField& field = *fieldNamed(name);
  return {field.array, field.isVector};
}

std::string unitOfContactField(const ModelRecord& model, const std::string& name) {
  return unitOf(model, *fieldNamed(name));
}

Eigen::VectorXd contactValues(const ContactRecord& contact, const std::string& name) {
  if (name == "contact_pressure") return contact.quadraturePressure;
  const Eigen::Index count = contact.quadraturePressure.size();
  Eigen::VectorXd values = Eigen::VectorXd::Zero(count);
  if (contact.quadratureSliding.empty()) return values;
  if (name == "friction_traction") values = contact.quadratureFriction.colwise().norm();
  if (name == "slip") values = contact.quadratureSlip.colwise().norm();
  if (name == "slipped" && contact.quadratureSlipped.size() > 0) values = contact.quadratureSlipped;
  if (name == "sliding")
    values = Eigen::Map<const Eigen::VectorXi>(contact.quadratureSliding.data(), count).cast<double>();
  return values;
}

vtkSmartPointer<vtkPolyData> contactFieldFaces(const ModelRecord& model, const FrameRecord& frame,
                                               const std::string& name) {
  const ContactField& field = *fieldNamed(name);
  const std::string array = labelled(field.array, unitOf(model, field));
  vtkSmartPointer<vtkPolyData> faces;
  for (const ContactName& contact : contactsOf(frame)) {
    const auto surface = contactSurfaceToEdges(model, frame, contact);
    vtkDataArray* values = surface->GetPointData()->GetArray(array.c_str());
    if (values == nullptr) continue;  // there is no friction
    keepAmounts(*surface, *values);
    faces = faces ? together(*faces, *surface) : surface;
  }
  return statesOfContactField(name).empty() ? faces : Pieces(*faces).finish();
}

}  // namespace burnish
