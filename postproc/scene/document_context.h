#pragma once
#include "engine/scene/check_context.h"
#include "postproc/scene/scene_document.h"

namespace burnish {

/// What every check of a document looks at, and where it reports.
struct DocumentContext : CheckContext {
  const SceneDocument& document;
};

/// Pictures.
void checkPictures(const DocumentContext& context);

/// Probes.
void checkProbes(const DocumentContext& context);

/// Variants and checks.
void checkChecks(const DocumentContext& context);

}  // namespace burnish
