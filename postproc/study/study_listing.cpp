#include "postproc/study/study_listing.h"

#include "engine/schema/declaration_collector.h"
#include "postproc/study/schema.h"

namespace burnish {

Declarations studyDeclarations() {
  return declarationsOf<StudySpec>();
}

std::string describeStudy() {
  return listKeys(studyDeclarations());
}

}  // namespace burnish
