/// How a run ends before all is done.
#pragma once

namespace bemcal::run {

enum class Stopping {
    no,
    after_items,  ///< what runs is finished
    soon          ///< what runs has a second, then it is left behind, to be done again
};

}  // namespace bemcal::run
