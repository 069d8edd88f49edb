#include "postproc/study/study_listing.h"

#include "engine/scene/mapping_lister.h"
#include "postproc/study/schema.h"

namespace burnish {

std::string describeStudy() {
  return listKeys<StudySpec>();
}

}  // namespace burnish
