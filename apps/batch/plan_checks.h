// What can be wrong with a plan as a whole: outputs that would meet inputs, or each other.
#pragma once

#include <string>

namespace folprom::batch {

struct Job;
struct Plan;

/// Throws Failure kOutput where the folder, or the nearest one above that exists, is none or may
/// not be written to.
void CheckFolder(const Job& job, const std::string& folder);

/// Throws Failure: kUsage where an output is an input, would be one in the next run, or belongs to
/// two operations; kOutput where one stands already and may not be replaced.
void CheckOutputs(const Plan& plan);

}  // namespace folprom::batch
