function initialize() {
  outline = new MFVec2f(new SFVec2f(r, 0), new SFVec2f(0, r));
  outline[2] = outline[0];
}
