//! The drum in its own frame: a rim, handled analytically, and outlines (baffles, straight walls), queried with parry2d.
