// An increment accepted: the trial becomes the state of the run.

#pragma once

#include "process/state/run.h"

namespace billet::process {

/// Makes the trial the state of the run.
void commit(Run& run, double dt);

/// Takes the increment just accepted into the sums over contact.
void account_contact(Run& run, double dt);

void accept(Run& run, double dt);

} // namespace billet::process
