#include "postproc/view/view.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/interruption.h"
#include "engine/core/version.h"
#include "postproc/draw/contour/color_range.h"
#include "postproc/draw/contour/contour.h"
#include "postproc/draw/contour/contour_parts.h"
#include "postproc/draw/contour/contour_series.h"
#include "postproc/draw/contour/field_choice.h"
#include "postproc/draw/contour/field_colors.h"
#include "postproc/draw/contour/frame_pictures.h"
#include "postproc/draw/contour/scalar_bar.h"
#include "postproc/draw/contour/shown_model.h"
#include "postproc/draw/page/doubt_mark.h"
#include "postproc/export/scratch_directory.h"
#include "postproc/mesh/chosen_bodies.h"
#include "postproc/mesh/contact_field.h"
#include "postproc/text/json_text.h"
#include "postproc/text/page.h"
#include "postproc/text/text_file.h"
#include "postproc/view/view_mesh.h"
#include "postproc/view/view_texts.h"
#include "postproc/view/view_tools.h"

namespace burnish {
namespace {

using Range = std::array<double, 2>;

/// Of the picture for those without WebGL.
constexpr std::array<int, 2> kFallbackSize{1280, 720};
constexpr double kMegabyte = 1e6;
constexpr int kDigits = 17;

/// How far tools that have no end are drawn beyond the bodies, as a part of the diagonal of these.
constexpr double kToolReach = 1.5;

std::string hexText(const Color& color) {
  return fmt::format("#{:02x}{:02x}{:02x}", color[0], color[1], color[2]);
}

Json::Value themeJson(const Theme& theme) {
  Json::Value json;
  json["paper"] = hexText(theme.paper);
  json["ink"] = hexText(theme.ink);
  json["soft"] = hexText(theme.softInk);
  json["outline"] = hexText(theme.outline);
  json["undeformed"] = hexText(theme.undeformed);
  json["knots"] = hexText(theme.knots);
  json["tool"] = hexText(theme.tool);
  return json;
}

/// Pieces of text with 0, or 1 for an index, 2 for an exponent.
Json::Value richJson(const RichText& text) {
  Json::Value json = Json::arrayValue;
  for (const TextRun& run : text) {
    Json::Value piece = Json::arrayValue;
    piece.append(run.text);
    piece.append(static_cast<int>(run.script));
    json.append(piece);
  }
  return json;
}

template <class Numbers>
Json::Value numbersJson(const Numbers& numbers) {
  Json::Value json = Json::arrayValue;
  for (const auto& number : numbers) json.append(number);
  return json;
}

/// Values of a field in a frame.
struct FieldValues {
  std::string values;  ///< see `floatsText`
  Range extremes{};
  std::vector<int> without;  ///< bodies
  Json::Value faces;         ///< of a contact field, with its values; null else
};

/// A field in all frames.
struct ViewField {
  std::string name;
  FieldChoice words;  ///< of the first frame
  Range whole{}, shown{};
  std::vector<FieldValues> frames;
};

/// Gathers what the page needs, frame by frame.
class PageData {
 public:
  PageData(const ResultReader& result, const std::vector<std::string>& fields, const ViewOptions& options)
      : result_(result), options_(options) {
    for (const std::string& name : fields) fields_.push_back({name, {}, {}, {}, {}});
  }

  void add(int index) {
    throwIfInterrupted();
    const FrameRecord frame = result_.frame(index);
    withShownModel(result_.model(), frame, options_,
                   [&](const ModelRecord& shown, const FrameRecord& its) { add(shown, its); });
  }

  /// Bytes that the page has at least.
  std::size_t size() const { return size_; }

  /// Everything but the picture for those without WebGL.
  Json::Value json() const {
    const ModelRecord& model = result_.model();
    Json::Value data;
    data["program"] = programName();
    data["title"] = options_.title.value_or(model.title);
    data["doubt"] = options_.doubtMarks ? doubtMarkOf(result_.file().parent_path()) : "";
    data["dim"] = model.dim;
    data["axes"] = numbersJson(viewAxes(options_.view, model.dim).reshaped<Eigen::RowMajor>());
    const Eigen::AlignedBox2d window = options_.window.value_or(window_);
    data["window"] =
        numbersJson(std::array{window.min().x(), window.min().y(), window.max().x(), window.max().y()});
    data["origin"] = numbersJson(origin_);
    data["box"] = numbersJson(Eigen::Vector<double, 6>(
        (Eigen::Vector<double, 6>() << box_.min() - origin_, box_.max() - origin_).finished()));
    data["light"] = themeJson(options_.pageTheme ? *options_.pageTheme : themeNamed("paper"));
    data["dark"] = themeJson(options_.pageTheme ? *options_.pageTheme : themeNamed("dark"));
    data["isThemed"] = options_.pageTheme.has_value();
    data["toolOpacity"] = model.dim == 2 ? 1.0 : options_.toolOpacity;
    Json::Value& show = data["show"];
    show["bands"] = options_.bands;
    show["isolines"] = options_.isolines;
    show["knots"] = options_.knots;
    show["undeformed"] = options_.undeformed;
    show["tools"] = options_.tools;
    data["fields"] = Json::arrayValue;
    for (const ViewField& field : fields_) data["fields"].append(fieldJson(field));
    data["meshes"] = Json::arrayValue;
    for (const ViewMesh& mesh : meshes_) data["meshes"].append(mesh.json);
    data["undeformed"] = undeformed_;
    data["tools"] = Json::arrayValue;
    const double reach = kToolReach * box_.diagonal().norm();
    Eigen::AlignedBox3d room = box_;
    room.extend(box_.min() - Eigen::Vector3d::Constant(reach));
    room.extend(box_.max() + Eigen::Vector3d::Constant(reach));
    for (const auto& tools : tools_)
      data["tools"].append(viewTools(tools, model.dim, model.dim == 2 ? room : box_, origin_, turns_));
    data["frames"] = frames_;
    for (Json::ArrayIndex k = 0; k < frames_.size(); ++k)
      for (const ViewField& field : fields_) data["frames"][k]["fields"].append(valuesJson(field, k));
    return data;
  }

  /// How the first field is drawn in a picture of the last frame.
  ContourOptions pictureOptions() const {
    ContourOptions picture(options_);
    picture.field = fields_.front().name;
    if (fields_.front().words.states.empty()) picture.range = scaleOf(fields_.front()).range();
    picture.clip.reset();  // it is in the range
    picture.window = options_.window.value_or(window_);
    picture.size = kFallbackSize;
    picture.title = "";  // the page has it
    return picture;
  }

 private:
  void add(const ModelRecord& model, const FrameRecord& frame) {
    const MeshRecord& mesh = meshOf(model, frame);
    if (!frame.displacement.allFinite())
      throw Error(fmt::format("displacement of frame {} holds values that are not finite; it cannot be drawn",
                              frame.index));
    if (frames_.empty()) begin(model);
    Json::Value json;
    json["number"] = frame.index;
    json["step"] = frame.step;
    json["time"] = fmt::format("{:.6g}", frame.time);
    const std::size_t number = frame.mesh ? numberOf(mesh) : meshOfModel_;
    json["mesh"] = static_cast<int>(number);
    json["positions"] =
        positionsText(controlPoints(meshes_[number], mesh, options_.warp * frame.displacement));
    if (tools_.empty() || tools_.back().size() != model.tools.size()) tools_.push_back(model.tools);
    json["tools"] = static_cast<int>(tools_.size()) - 1;
    const Eigen::MatrixXd motion = toolMotion(model, frame, options_.warp);
    json["motion"] = numbersJson(motion.reshaped());
    for (std::size_t k = 0; k < model.tools.size(); ++k)
      if (!model.tools[k].isThereAt(frame.time)) json["gone"].append(static_cast<int>(k));
    turns_ = turns_ || (frame.toolAngle.array() != 0.0).any();
    size_ += json["positions"].asString().size();
    for (ViewField& field : fields_) {
      add(field, model, frame, meshes_[number].nodes);
      const FieldValues& added = field.frames.back();
      size_ += added.values.size() + added.faces["points"].asString().size();
    }
    frames_.append(json);
  }

  /// Puts the origin into the middle of the undeformed bodies, where floats are fine.
  void begin(const ModelRecord& model) {
    Eigen::AlignedBox3d box;
    for (const PatchRecord& patch : model.mesh.patches)
      for (const auto& point : patch.points.colwise()) box.extend(inSpace(point));
    origin_ = box.center();
    meshOfModel_ = numberOf(model.mesh);
    undeformed_["mesh"] = static_cast<int>(meshOfModel_);
    undeformed_["positions"] = positionsText(controlPoints(meshes_[meshOfModel_], model.mesh, {}));
  }

  static Eigen::Vector3d inSpace(const Eigen::VectorXd& point) {
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    x.head(point.size()) = point;
    return x;
  }

  std::string positionsText(Eigen::MatrixXd points) const {
    points.colwise() -= origin_.head(points.rows());
    return floatsText(points);
  }

  /// Whether the page has what is inside bodies.
  bool showsSections() const {
    return result_.model().dim == 3 && options_.pageCutFace == CutFace::Field &&
           std::any_of(fields_.begin(), fields_.end(),
                       [](const ViewField& field) { return !isContactField(field.name); });
  }

  /// Of a mesh in the page; frames between two remeshings have the same.
  std::size_t numberOf(const MeshRecord& mesh) {
    ViewMesh view = viewMesh(mesh, showsSections());
    const auto same = std::find_if(meshes_.begin(), meshes_.end(),
                                   [&](const ViewMesh& other) { return other.json == view.json; });
    if (same != meshes_.end()) return static_cast<std::size_t>(same - meshes_.begin());
    meshes_.push_back(std::move(view));
    return meshes_.size() - 1;
  }

  void add(ViewField& field, const ModelRecord& model, const FrameRecord& frame,
           const std::vector<int>& nodes) {
    FieldChoice choice = chooseField(model, frame, field.name);
    if (choice.faces && (options_.warp != 1.0 || options_.clip))
      throw Error(fmt::format("{}: {} belongs to the faces in contact; write the page without it",
                              options_.clip ? "clip" : "warp", field.name));
    const FieldRange range = fieldRanges(model, frame, choice, model.subdivision, options_.clip);
    FieldValues values{"", range.whole, {}, {}};
    if (choice.faces)
      values.faces = partJson(choice.faces, origin_);
    else
      values.values = floatsText(choice.coefficients(Eigen::all, nodes));
    const std::vector<std::string> without = bodiesWithout(model, frame, field.name);
    for (std::size_t body = 0; body < model.bodies.size(); ++body)
      if (std::find(without.begin(), without.end(), model.bodies[body]) != without.end())
        values.without.push_back(static_cast<int>(body));
    if (&field == &fields_.front()) see(model, frame, choice);
    if (field.frames.empty()) {
      field.whole = range.whole;
      field.shown = range.shown;
      field.words = std::move(choice);
    }
    field.whole = {std::min(field.whole[0], range.whole[0]), std::max(field.whole[1], range.whole[1])};
    field.shown = {std::min(field.shown[0], range.shown[0]), std::max(field.shown[1], range.shown[1])};
    field.frames.push_back(std::move(values));
  }

  /// Window and box hold what is to be seen of all frames.
  void see(const ModelRecord& model, const FrameRecord& frame, const FieldChoice& field) {
    const ContourParts parts = contourParts(model, frame, field, options_);
    box_.extend(parts.box);
    window_.extend(contentOf(parts, model.dim));
  }

  ColorScale scaleOf(const ViewField& field) const {
    return colorScaleOf(field.words, options_, options_.range.value_or(field.shown));
  }

  ScalarBar barOf(const ViewField& field, const Range& values) const {
    return {scaleOf(field),
            {field.words.title, field.words.unit, values[0], values[1], field.words.states},
            16.0,
            Theme()};
  }

  Json::Value fieldJson(const ViewField& field) const {
    PictureOptions smooth = options_;
    smooth.bands = 0;  // the page makes them
    const ColorScale scale = colorScaleOf(field.words, smooth, options_.range.value_or(field.shown));
    const ScalarBar bar = barOf(field, field.whole);
    const Ticks ticks = bar.marks();
    std::string colors;
    for (const Color& color : scale.colors()) colors.append(color.begin(), color.end());
    Json::Value json;
    json["name"] = field.name;
    json["words"] = field.words.words;
    json["title"] = richJson(bar.title());
    json["components"] = static_cast<int>(field.words.coefficients.rows());
    json["nonNegative"] = field.words.isNonNegative;
    json["isOfContact"] = field.words.faces != nullptr;
    json["hasStates"] = !field.words.states.empty();
    json["colors"] = base64(colors);
    json["range"] = numbersJson(scale.range());
    json["ticks"] = numbersJson(ticks.values);
    json["labels"] = numbersJson(ticks.labels);
    json["exponent"] = ticks.exponent;
    return json;
  }

  Json::Value valuesJson(const ViewField& field, std::size_t frame) const {
    const FieldValues& values = field.frames[frame];
    const ScalarBar bar = barOf(field, values.extremes);
    Json::Value json;
    json["values"] = values.values;
    json["extremes"] = numbersJson(values.extremes);
    json["smallest"] = richJson(bar.smallest());
    json["largest"] = richJson(bar.largest());
    json["without"] = numbersJson(values.without);
    if (!values.faces.isNull()) json["faces"] = values.faces;
    return json;
  }

  const ResultReader& result_;
  const ViewOptions& options_;
  std::vector<ViewField> fields_;
  std::vector<ViewMesh> meshes_;
  std::vector<std::vector<ToolRecord>> tools_;  ///< frames with another number of images have others
  std::size_t meshOfModel_ = 0;
  Json::Value undeformed_, frames_ = Json::arrayValue;
  std::size_t size_ = 0;  ///< of the numbers of the frames
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  Eigen::AlignedBox3d box_;
  Eigen::AlignedBox2d window_;
  bool turns_ = false;
};

/// What is most wanted of what the frame has.
std::vector<std::string> usualFields(const ResultReader& result, int frame) {
  const FrameRecord last = result.frame(frame);
  const std::vector<std::string> names = fieldNames(last);
  std::vector<std::string> fields;
  for (const char* name : {"plastic_strain", "von_mises", "displacement"})
    if (std::find(names.begin(), names.end(), name) != names.end()) fields.emplace_back(name);
  return fields;
}

/// What a window of the browser is called: the title, or the name of the run.
std::string nameOf(const std::string& title, const ResultReader& result) {
  return title.empty() ? std::filesystem::absolute(result.file()).parent_path().filename().string() : title;
}

void requireSize(std::size_t bytes, int dim, const ViewOptions& options, const std::filesystem::path& html) {
  const double size = static_cast<double>(bytes) / kMegabyte;
  if (size > options.maxSize)
    throw Error(fmt::format(
        "{}: the page would have {:.3g} MB or more, above --max-size {:.6g}; take fewer frames (--frames) or fields "
        "(--field), {}or allow more",
        html.string(), size, options.maxSize,
        dim == 3 && options.pageCutFace == CutFace::Field ? "leave out what is inside (--cut-face hatch), "
                                                          : ""));
}

}  // namespace

HtmlPage viewPage(const ResultReader& result, const std::vector<int>& frames,
                  const std::vector<std::string>& fields, const ViewOptions& options,
                  const std::filesystem::path& html) {
  PageData data(result, fields.empty() ? usualFields(result, frames.back()) : fields, options);
  for (const int frame : frames) {
    data.add(frame);
    requireSize(data.size(), result.model().dim, options, html);
  }
  const ScratchDirectory scratch;
  const std::string picture =
      framePicture(result, result.frame(frames.back()), data.pictureOptions(), scratch.path());
  const Json::Value json = data.json();
  HtmlPage page{
      .title = nameOf(json["title"].asString(), result),
      .style = kViewStyle,
      .body = filled(kViewPage, {{"/*picture*/", pngUri(picture)}, {"/*data*/", scriptText(json, kDigits)}}),
      .script = kViewScript,
      .scriptHash = kViewScriptHash,
      .styleHash = kViewStyleHash};
  requireSize(page.style.size() + page.body.size() + page.script.size(), result.model().dim, options, html);
  return page;
}

std::size_t writeView(const ResultReader& result, const std::vector<int>& frames,
                      const std::vector<std::string>& fields, const ViewOptions& options,
                      const std::filesystem::path& html) {
  const std::string text = htmlText(viewPage(result, frames, fields, options, html));
  writeText(text, html);
  return text.size();
}

}  // namespace burnish
