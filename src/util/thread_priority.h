#pragma once

namespace cpslam {

/// From now on the calling thread, and those it starts, run only with the time that the process's other
/// threads leave when all cores are busy. Cannot be taken back. Does nothing where the system has no such
/// thing.
void give_way_to_other_threads();

}  // namespace cpslam
