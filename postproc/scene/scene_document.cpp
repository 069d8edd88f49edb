#include "postproc/scene/scene_document.h"

#include <fmt/format.h>

#include "engine/results/result_reader.h"
#include "engine/scene/scene_reading.h"
#include "engine/schema/mapping_writer.h"
#include "postproc/scene/document_context.h"
#include "postproc/scene/schema_document.h"

namespace burnish {
namespace {

/// Whether `burnish verify` runs other scenes than this one, whose histories may have other columns.
bool isChangedByVariants(const SceneDocument& document) {
  return document.variants && !(document.variants->families.empty() && document.variants->meshes.empty());
}

Wanted wantedBy(const SceneDocument& document) {
  Wanted wanted;
  wanted.onlyWarns = isChangedByVariants(document);
  for (const ScenePicture& picture : document.pictures)
    wanted.frames.insert(wanted.frames.end(), picture.times.begin(), picture.times.end());
  for (const SceneProbe& probe : document.probes)
    wanted.frames.insert(wanted.frames.end(), probe.times.begin(), probe.times.end());
  for (std::size_t k = 0; k < document.checks.size(); ++k)
    wanted.quantities.push_back({fmt::format("checks[{}].quantity", k), document.checks[k].quantity.formula});
  for (std::size_t k = 0; k < document.charts.size(); ++k) {
    if (!document.charts[k].contact.empty()) continue;
    wanted.quantities.push_back({fmt::format("charts[{}].x", k), document.charts[k].x});
    wanted.quantities.push_back({fmt::format("charts[{}].y", k), document.charts[k].y});
  }
  return wanted;
}

}  // namespace

SceneDocument parseSceneDocument(const std::string& yaml, const std::string& name,
                                 const std::vector<std::string>& overrides) {
  SceneReading reading(yaml, name, overrides);
  for (YamlNode& list : reading.root().children)
    if (list.key == "pictures")
      for (YamlNode& picture : list.children)
        resolveLookFiles(picture, std::filesystem::path(name).parent_path());
  SceneDocument document;
  reading.read(document);
  reading.check(document.scene);
  const DocumentContext context{{document.scene, reading.root(), reading.errors()}, document};
  checkPictures(context);
  checkProbes(context);
  checkChecks(context);
  reading.finish(document.scene, yamlOf(document));
  document.scene.wanted = wantedBy(document);
  return document;
}

ScenePicture firstPicture(const SceneDocument& document) {
  if (document.pictures.empty()) return {};
  return document.pictures.front();
}

SceneDocument readSceneDocument(const std::filesystem::path& file,
                                const std::vector<std::string>& overrides) {
  return parseSceneDocument(readDocument(file, kSceneKind), file.string(), overrides);
}

SceneDocument readResultDocument(const std::filesystem::path& directory) {
  const ResultReader result(directory);
  return parseSceneDocument(result.model().sceneYaml, result.file().string());
}

}  // namespace burnish
