// What the device "webgl" and a frame under way tell the worker that runs them: Module.handed gets copies of words,
// Module.progressed the share done.
mergeInto(LibraryManager.library, {
  petzval_hand_over: function (name, words, count) {
    Module.handed(UTF8ToString(name), HEAPU32.slice(words >> 2, (words >> 2) + count));
  },
  petzval_page_progress: function (done) {
    Module.progressed(done);
  },
});
