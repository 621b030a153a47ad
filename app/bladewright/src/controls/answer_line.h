// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

class QLabel;

namespace bw::app {

/// For a sentence that becomes known after the other things of a form: it takes two lines from the beginning,
/// so that nothing moves when it comes, and the form is no wider for it.
QLabel* makeAnswer();

}  // namespace bw::app
