/// Ends that nobody planned: a library that ends the program, an exception that nobody
/// takes. They get a message and a code of their own, and no core file.
///
/// OpenMP's library, for one, ends the program with 1 where it cannot start a thread, and
/// 1 is what we say for a missed target.
#pragma once

namespace bemcal::run {

/// From now on; once, at the program's start.
void watch_for_unplanned_end();

/// The program ends now because it is done, or has said why it is not.
void end_is_planned();

}  // namespace bemcal::run
