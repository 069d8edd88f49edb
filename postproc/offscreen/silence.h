#pragma once

namespace burnish {

/// Keeps VTK from printing on standard error: what went wrong is told by our own messages. For the whole
/// process.
void silenceVtk();

}  // namespace burnish
