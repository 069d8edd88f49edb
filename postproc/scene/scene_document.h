#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/scene/scene.h"
#include "postproc/draw/contour/picture_options.h"
#include "postproc/probe/probe_spec.h"
#include "postproc/scene/scene_checks.h"

namespace burnish {

/// The ending of a picture's file.
enum class PictureFormat { Png, Pdf, Svg };

constexpr auto enumNames(std::type_identity<PictureFormat>) {
  return std::array{std::pair{"png", PictureFormat::Png}, std::pair{"pdf", PictureFormat::Pdf},
                    std::pair{"svg", PictureFormat::Svg}};
}

/// A contour picture of a scene.
struct ScenePicture : PictureOptions {
  std::optional<std::string> name;  ///< file name stem; the field's name when left out
  std::vector<double> times;        ///< one picture for each; the last frame when empty
  PictureFormat format = PictureFormat::Png;

  bool isForPrint() const { return format != PictureFormat::Png; }
};

/// Values along a path or over time, of a scene.
struct SceneProbe : ProbeSpec {
  std::string name;           ///< file name stem
  std::vector<double> times;  ///< a curve for each; the last frame when empty
};

/// What a scene's file says: the scene that the engine computes, the pictures and charts to be drawn of its results,
/// and what `burnish verify` makes of it. `scene.resolvedYaml` is the whole document, and `scene.wanted` says
/// what the document needs of a run.
struct SceneDocument {
  Scene scene;
  std::vector<ScenePicture> pictures;
  std::vector<SceneProbe> probes;
  std::optional<VariantsSpec> variants;
  std::vector<CheckSpec> checks;
  std::vector<CurveChartSpec> charts;
};

/// The first picture, or one without options if there is none.
ScenePicture firstPicture(const SceneDocument& document);

/// Reads and checks a document as `readScene` does a scene, with all of its keys.
SceneDocument readSceneDocument(const std::filesystem::path& file,
                                const std::vector<std::string>& overrides = {});

/// The same for a document in memory; `name` stands for the file in messages.
SceneDocument parseSceneDocument(const std::string& yaml, const std::string& name,
                                 const std::vector<std::string>& overrides = {});

/// The document of the result in a directory, every default filled in. Throws `Error` if there is none.
SceneDocument readResultDocument(const std::filesystem::path& directory);

}  // namespace burnish
