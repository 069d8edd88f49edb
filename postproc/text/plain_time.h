#pragma once

namespace burnish {

/// A time as whoever asked for it wrote it: 0.3 instead of the 0.30000000000000004 that steps of 0.1 add up to,
/// and 1/3 as it is. The nearest number of 12 digits if that is within rounding.
double plainTime(double time);

}  // namespace burnish
