#include "engine/scene/reader.h"

#include "engine/scene/scene_reading.h"
#include "engine/scene/schema.h"
#include "engine/schema/declaration_collector.h"
#include "engine/schema/mapping_reader.h"
#include "engine/schema/mapping_writer.h"

namespace burnish::inline scene {

template void describeSimulation(MappingReader&, Scene&);
template void describeSimulation(MappingWriter&, Scene&);
template void describeSimulation(DeclarationCollector&, Scene&);

Scene parseScene(const std::string& yaml, const std::string& name,
                 const std::vector<std::string>& overrides) {
  SceneReading reading(yaml, name, overrides);
  Scene scene;
  reading.read(scene, keysOfDocuments());
  reading.check(scene);
  reading.finish(scene, yamlOf(scene));
  return scene;
}

Scene readScene(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  return parseScene(readDocument(file, kSceneKind), file.string(), overrides);
}

}  // namespace burnish::inline scene
