/// Memory of models that follow each other.
#pragma once

namespace bemcal::run {

/// Freed arrays stay with the process, for the next that are as large. A search builds
/// thousands of models of tens of megabytes, one after the other; the system would clear
/// their pages for each anew.
void keep_freed_memory();

}  // namespace bemcal::run
