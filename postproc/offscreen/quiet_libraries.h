#pragma once

namespace burnish {

/// Keeps VTK from printing on standard error: what went wrong is told by our own messages. For the whole
/// process.
void silenceVtk();

/// Keeps the environment from harming Mesa: without a place for compiled shaders it would print so on
/// standard error, and a driver that is not one of its own for software would end the program, or draw other
/// pictures on other graphics cards. To be called before there is a context.
void prepareMesa();

}  // namespace burnish
