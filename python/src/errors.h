// SPDX-License-Identifier: GPL-3.0-or-later
//
// The exceptions of the library as those of the same names in Python.

#ifndef SMA_PYTHON_ERRORS_H
#define SMA_PYTHON_ERRORS_H

namespace sma_python {

void translate_errors();

} // namespace sma_python

#endif // SMA_PYTHON_ERRORS_H
