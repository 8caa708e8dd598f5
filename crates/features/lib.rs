//! The features by which the workspaces of stickslip compile their dependencies once for all.
