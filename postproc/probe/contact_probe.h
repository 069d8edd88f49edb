#pragma once
#include "engine/results/result.h"
#include "postproc/probe/face_address.h"
#include "postproc/probe/probe.h"
#include "postproc/probe/probed_run.h"

/// Contact fields along a face of a plane body: what the solver has at the quadrature points of the face, over the arc
/// length of the deformed face; in space along a line laid on that, between these points.
namespace burnish {

/// Whether a spec without `conflictsIn` asks for contact fields.
bool isOfContact(const ProbeSpec& spec);

/// The values at the points of a face of a spec with `isOfContact`, or their means over its window, linear between them; in
/// space those at points of the line, bilinear in the parameters of the face between the solver's points, as pictures have
/// them, and of states that of the nearest one. Where several partners touch the face their pressures and frictions are added; of states and ways there is the largest.
/// Throws `Error` for a frame without these fields, for a path that does not fit the body, and for a face that has no contact.
ProbedRun probedContact(const ModelRecord& model, const FrameRecord& frame, const ProbeSpec& spec);

/// The means over all of the face, at the time of the frame. Throws as `probedContact`.
ProbePoint probedContactMean(const ModelRecord& model, const FrameRecord& frame, const ProbeSpec& spec);

/// Names of the fields, as charts have them.
std::vector<FieldChoice> contactChoices(const ModelRecord& model, const FrameRecord& frame,
                                        const ProbeSpec& spec);

}  // namespace burnish
