#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/results/result.h"

namespace burnish::inline results {

/// A model and the identity that its frames refer to: a checksum of its contents.
struct StoredModel {
  std::string id;
  ModelRecord record;
};

std::string modelId(const ModelRecord& model);

/// The model file as bytes.
std::vector<std::byte> modelImage(const StoredModel& model);

/// Throws `Error` if the file is not a whole model.
StoredModel readModel(const std::filesystem::path& path);

}  // namespace burnish::inline results
