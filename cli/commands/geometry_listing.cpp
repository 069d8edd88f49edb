#include "cli/commands/geometry_listing.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "cli/commands/info_line.h"
#include "engine/core/lower_case.h"
#include "engine/core/unit_label.h"
#include "engine/scene/net_formats.h"
#include "engine/schema/diagnostics.h"
#include "engine/schema/yaml_document.h"

namespace burnish {
namespace {

const DocumentKind kGeometryKind{.name = "file of NURBS", .keys = "shape", .format = "g2 or JSON"};

double numberIn(const YamlNode& node) {
  double value = 0.0;
  std::from_chars(node.text.data(), node.text.data() + node.text.size(), value);
  return value;
}

ListedNet listedNet(const YamlNode& net) {
  ListedNet listed;
  const YamlNode &degrees = *net.find("degrees"), &knots = *net.find("knots");
  for (std::size_t d = 0; d < degrees.children.size(); ++d) {
    listed.degrees.push_back(static_cast<int>(numberIn(degrees.children[d])));
    listed.functions.push_back(static_cast<int>(knots.children[d].children.size()) - listed.degrees[d] - 1);
  }
  if (const YamlNode* weights = net.find("weights"))
    listed.isRational = std::ranges::any_of(weights->children, [weights](const YamlNode& weight) {
      return numberIn(weight) != numberIn(weights->children.front());
    });
  for (const YamlNode& point : net.find("points")->children) {
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    for (std::size_t c = 0; c < std::min<std::size_t>(3, point.children.size()); ++c)
      place(static_cast<Eigen::Index>(c)) = numberIn(point.children[c]);
    listed.box.extend(place);
  }
  return listed;
}

std::string textAt(const YamlNode& holder, const char* key) {
  const YamlNode* found = holder.kind == YamlNode::Kind::Mapping ? holder.find(key) : nullptr;
  return found != nullptr && found->kind == YamlNode::Kind::Scalar ? found->text : "";
}

void addNets(GeometryListing& listing, const std::vector<YamlNode>& nets) {
  for (const YamlNode& net : nets) listing.nets.push_back(listedNet(net));
}

GeometryListing listG2(const std::filesystem::path& file) {
  GeometryListing listing{.file = file, .kind = "g2"};
  Diagnostics errors(file.string(), {});
  const auto nets = netsOfG2(readDocument(file, kGeometryKind), 0, "", errors);
  errors.throwIfAny();
  addNets(listing, *nets);
  return listing;
}

std::optional<GeometryListing> listJson(const std::filesystem::path& file) {
  GeometryListing listing{.file = file, .kind = "JSON of NURBS"};
  Diagnostics errors(file.string(), {});
  const std::string text = readDocument(file, kGeometryKind);
  isJson(text, 0, "", errors);
  errors.throwIfAny();
  const auto document = parseYaml(text, 0, errors);
  errors.throwIfAny();
  if (!document || document->kind != YamlNode::Kind::Mapping || document->find("shape") == nullptr)
    return std::nullopt;
  const auto nets = netsOfJson(*document, "", errors);
  errors.throwIfAny();
  listing.unit = textAt(*document, "unit");
  addNets(listing, *nets);
  const std::vector<YamlNode>& data = document->find("shape")->find("data")->children;
  for (std::size_t k = 0; k < data.size(); ++k) listing.nets[k].name = textAt(data[k], "name");
  return listing;
}

GeometryListing listOfCad(const std::filesystem::path& file, bool isStep) {
  CadListing found = listCad(file.string());
  return {.file = file,
          .kind = isStep ? "STEP" : "IGES",
          .unit = found.fileUnit,
          .unitOfBoxes = labelOf(found.unit),
          .solids = std::move(found.solids),
          .shells = std::move(found.shells),
          .faces = std::move(found.faces)};
}

std::string boxText(const Eigen::AlignedBox3d& box) {
  if (box.isEmpty()) return "nothing";
  return fmt::format("({:.6g}) to ({:.6g})", fmt::join(box.min(), ", "), fmt::join(box.max(), ", "));
}

/// "3: name, " or, without a name, "3: ".
std::string beginOf(std::size_t number, const std::string& name) {
  return name.empty() ? fmt::format("{}: ", number) : fmt::format("{}: {}, ", number, infoWords(name));
}

const char* kindOfNet(const ListedNet& net) {
  constexpr std::array kKinds{"curve", "surface", "volume"};
  return kKinds[net.degrees.size() - 1];
}

Json::Value vectorJson(const Eigen::Vector3d& vector) {
  Json::Value list(Json::arrayValue);
  for (const double x : vector) list.append(x);
  return list;
}

Json::Value partJson(std::size_t number, const std::string& name, const Eigen::AlignedBox3d& box) {
  Json::Value part;
  part["number"] = static_cast<Json::UInt64>(number);
  part["name"] = name;
  if (box.isEmpty()) return part;
  part["box"].append(vectorJson(box.min()));
  part["box"].append(vectorJson(box.max()));
  return part;
}

}  // namespace

std::optional<GeometryListing> listGeometry(const std::filesystem::path& file) {
  const std::string ending = inLowerCase(file.extension().string());
  if (isCadFile(file)) return listOfCad(file, ending == ".step" || ending == ".stp");
  if (ending == ".g2") return listG2(file);
  if (ending == ".json") return listJson(file);
  return std::nullopt;
}

std::string geometryText(const GeometryListing& listing) {
  std::string text = infoLine("file", listing.file.string()) + infoLine("kind", listing.kind);
  if (!listing.unit.empty()) {
    const bool isOther = !listing.unitOfBoxes.empty() && !lengthUnitOf(inLowerCase(listing.unit));
    text +=
        infoLine("unit", infoWords(listing.unit) +
                             (isOther ? fmt::format("; boxes in {}", infoWords(listing.unitOfBoxes)) : ""));
  }
  for (std::size_t k = 0; k < listing.solids.size(); ++k) {
    const CadPart& solid = listing.solids[k];
    text += infoLine(
        "solid", fmt::format("{}{} faces, {}", beginOf(k + 1, solid.name), solid.faces, boxText(solid.box)));
  }
  const auto ofSolid = [](const CadPart& part) {
    return part.solid > 0 ? fmt::format(", of solid {}", part.solid) : "";
  };
  for (std::size_t k = 0; k < listing.shells.size(); ++k) {
    const CadPart& shell = listing.shells[k];
    const bool isSolid =
        shell.solid > 0 && std::ranges::count(listing.shells, shell.solid, &CadPart::solid) == 1;
    if (isSolid || shell.faces == 1) continue;  // its solid, or its face, stands for it
    text += infoLine("shell", fmt::format("{}{} faces{}, {}", beginOf(k + 1, shell.name), shell.faces,
                                          ofSolid(shell), boxText(shell.box)));
  }
  for (std::size_t k = 0; k < listing.faces.size(); ++k) {
    const CadPart& face = listing.faces[k];
    text +=
        infoLine("face", fmt::format("{}{}{}, {}", beginOf(k + 1, face.name),
                                     face.isExact ? "exact" : "trimmed", ofSolid(face), boxText(face.box)));
  }
  for (std::size_t k = 0; k < listing.nets.size(); ++k) {
    const ListedNet& net = listing.nets[k];
    text += infoLine("object",
                     fmt::format("{}{}, degree {}, {} functions, {}{}", beginOf(k, net.name), kindOfNet(net),
                                 fmt::join(net.degrees, " x "), fmt::join(net.functions, " x "),
                                 net.isRational ? "rational, " : "", boxText(net.box)));
  }
  return text;
}

Json::Value geometryJson(const GeometryListing& listing) {
  Json::Value value;
  value["file"] = listing.file.string();
  value["kind"] = listing.kind;
  value["unit"] = listing.unit;
  value["unit_of_boxes"] = listing.unitOfBoxes;
  for (const char* key : {"solids", "shells", "faces", "objects"}) value[key] = Json::Value(Json::arrayValue);
  for (std::size_t k = 0; k < listing.solids.size(); ++k) {
    Json::Value solid = partJson(k + 1, listing.solids[k].name, listing.solids[k].box);
    solid["faces"] = listing.solids[k].faces;
    value["solids"].append(std::move(solid));
  }
  for (std::size_t k = 0; k < listing.shells.size(); ++k) {
    Json::Value shell = partJson(k + 1, listing.shells[k].name, listing.shells[k].box);
    shell["faces"] = listing.shells[k].faces;
    shell["solid"] = listing.shells[k].solid;
    value["shells"].append(std::move(shell));
  }
  for (std::size_t k = 0; k < listing.faces.size(); ++k) {
    Json::Value face = partJson(k + 1, listing.faces[k].name, listing.faces[k].box);
    face["exact"] = listing.faces[k].isExact;
    face["solid"] = listing.faces[k].solid;
    value["faces"].append(std::move(face));
  }
  for (std::size_t k = 0; k < listing.nets.size(); ++k) {
    const ListedNet& net = listing.nets[k];
    Json::Value object = partJson(k, net.name, net.box);
    object["kind"] = kindOfNet(net);
    for (const int degree : net.degrees) object["degrees"].append(degree);
    for (const int functions : net.functions) object["functions"].append(functions);
    object["rational"] = net.isRational;
    value["objects"].append(std::move(object));
  }
  return value;
}

}  // namespace burnish
