// The types, functions and constants that ISO/IEC 14772-1 Annex C gives a Script, and those of ISO/IEC 19777-1 that are
// the same. They are made once; `begin` gives them to the environment of a Script. `ask` sends a request to the program and returns its
// answer, both as JSON; values travel as numbers, texts, and flat arrays of them, nodes by their numbers.
// `clock`: in a world that runs, gives the seconds since 1970; without one, time stands still and chance repeats itself.
(function (ask, clock) {
  'use strict';
  var shared = {};          // what every environment has
  var toJson = JSON.stringify, fromJson = JSON.parse;
  var instant = 946684800;  // seconds: the begin of the year 2000, for the same file has the same effect every day
  function now() { return clock ? clock() : instant; }
  var longest = 4000000;    // elements of a list

  function request(what) {
    var answer = fromJson(ask(toJson(what)));
    if (answer.error) throw new Error(answer.error);
    return answer;
  }
  function hide(object, name, value) {
    Object.defineProperty(object, name, {value: value, writable: true, configurable: true, enumerable: false});
  }
  function number(v) {
    if (v && typeof v === 'object' && v._ && v._.length === 1) v = v._[0];
    return +v;
  }
  function integer(v) { return number(v) | 0; }
  function text(v) { return v === null || v === undefined ? '' : String(v); }
  function truth(v) { return typeof v === 'string' ? v.toLowerCase() === 'true' : !!v; }

  // SFVec3f and its like: numbers that have names and indices.
  var tuples = {}, lists = {};
  function tuple(name, members, begin) {
    var size = members.length;
    var T = function () {
      if (!(this instanceof T)) return T.of(Array.prototype.slice.call(arguments));
      var numbers = begin.slice(), n = arguments.length;
      if (n === 1 && typeof arguments[0] === 'object' && arguments[0]) numbers = T.of(arguments[0])._.slice();
      else for (var i = 0; i < n && i < size; ++i) numbers[i] = number(arguments[i]);
      this._ = numbers;
    };
    T.of = function (v) {
      var numbers = begin.slice(), from = v && (v._ || v);
      if (from && typeof from === 'object')
        for (var i = 0; i < size; ++i) if (from[i] !== undefined) numbers[i] = number(from[i]);
      return T.made(numbers);
    };
    T.made = function (numbers) {
      var made = Object.create(T.prototype);
      made._ = numbers;
      return made;
    };
    T.size = size;
    members.concat(members.map(function (m, i) { return String(i); })).forEach(function (key, i) {
      var at = i % size;
      Object.defineProperty(T.prototype, key, {
        configurable: true,
        get: function () { return this._[at]; },
        set: function (v) { this._[at] = number(v); if (this.owner_) this.owner_(); }
      });
    });
    hide(T.prototype, 'length', size);
    hide(T.prototype, 'toString', function () { return this._.join(' '); });
    hide(T.prototype, 'equals', function (o) { return !!o && T.of(o)._.join() === this._.join(); });
    shared[name] = T;
    tuples[name] = T;
    return T;
  }
  function method(T, name, f) { hide(T.prototype, name, f); }
  function vector(T) {
    function map(f) {
      return function (o) {
        return T.made(this._.map(function (a, i) { return f(a, o && o._ ? o._[i] : number(o)); }));
      };
    }
    method(T, 'add', map(function (a, b) { return a + b; }));
    method(T, 'subtract', map(function (a, b) { return a - b; }));
    method(T, 'multiply', map(function (a, b) { return a * b; }));
    T.prototype.multiple = T.prototype.multiply;  // as Annex C spells it in places
    method(T, 'divide', map(function (a, b) { return a / b; }));
    method(T, 'negate', function () { return T.made(this._.map(function (a) { return -a; })); });
    method(T, 'dot', function (o) { return this._.reduce(function (s, a, i) { return s + a * o._[i]; }, 0); });
    method(T, 'length', function () { return Math.sqrt(this.dot(this)); });
    method(T, 'normalize', function () { return this.divide(this.length() || 1); });
    return T;
  }
  vector(tuple('SFVec2f', ['x', 'y'], [0, 0]));
  vector(tuple('SFVec2d', ['x', 'y'], [0, 0]));
  vector(tuple('SFVec4f', ['x', 'y', 'z', 'w'], [0, 0, 0, 1]));
  vector(tuple('SFVec4d', ['x', 'y', 'z', 'w'], [0, 0, 0, 1]));
  ['SFVec3f', 'SFVec3d'].forEach(function (name) {
    var T = vector(tuple(name, ['x', 'y', 'z'], [0, 0, 0]));
    method(T, 'cross', function (o) {
      var a = this._, b = o._;
      return T.made([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]);
    });
  });
  var SFVec3f = tuples.SFVec3f;
  var SFColor = tuple('SFColor', ['r', 'g', 'b'], [0, 0, 0]);
  tuple('SFColorRGBA', ['r', 'g', 'b', 'a'], [0, 0, 0, 1]);
  method(SFColor, 'setHSV', function (h, s, v) {
    var part = this;
    [5, 3, 1].forEach(function (n, i) {
      var k = (n + h / 60) % 6;
      part._[i] = v - v * s * Math.max(0, Math.min(k, 4 - k, 1));
    });
    if (this.owner_) this.owner_();
  });
  method(SFColor, 'getHSV', function () {
    var r = this._[0], g = this._[1], b = this._[2], v = Math.max(r, g, b), d = v - Math.min(r, g, b), h = 0;
    if (d > 0) h = v === r ? (g - b) / d : v === g ? 2 + (b - r) / d : 4 + (r - g) / d;
    return [(h * 60 + 360) % 360, v > 0 ? d / v : 0, v];
  });

  // SFRotation: an axis and an angle, which multiply as quaternions.
  var SFRotation = tuple('SFRotation', ['x', 'y', 'z', 'angle'], [0, 0, 1, 0]);
  function quaternion(r) {
    var a = r._, n = Math.sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]) || 1, s = Math.sin(a[3] / 2) / n;
    return [a[0] * s, a[1] * s, a[2] * s, Math.cos(a[3] / 2)];
  }
  function rotation(q) {
    var s = Math.sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2]);
    if (s < 1e-12) return SFRotation.made([0, 0, 1, 0]);
    return SFRotation.made([q[0] / s, q[1] / s, q[2] / s, 2 * Math.atan2(s, q[3])]);
  }
  function product(a, b) {
    return [a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1], a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
            a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3], a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]];
  }
  function between(from, to) {
    var a = from.normalize(), b = to.normalize(), axis = a.cross(b), cosine = a.dot(b);
    if (axis.length() > 1e-9) return axis.normalize()._.concat(Math.atan2(axis.length(), cosine));
    if (cosine > 0) return [0, 0, 1, 0];
    axis = a.cross(SFVec3f.made(Math.abs(a._[0]) < 0.9 ? [1, 0, 0] : [0, 1, 0])).normalize();
    return axis._.concat(Math.PI);
  }
  var plainRotation = SFRotation;
  SFRotation = function (a, b) {
    if (a instanceof SFVec3f)
      return plainRotation.made(b instanceof SFVec3f ? between(a, b) : a._.concat(number(b)));
    return arguments.length ? plainRotation.of(arguments.length === 1 ? a : Array.prototype.slice.call(arguments))
                            : plainRotation.made([0, 0, 1, 0]);
  };
  SFRotation.prototype = plainRotation.prototype;
  SFRotation.of = plainRotation.of;
  SFRotation.made = plainRotation.made;
  SFRotation.size = 4;
  shared.SFRotation = SFRotation;
  tuples.SFRotation = SFRotation;
  method(SFRotation, 'getAxis', function () { return SFVec3f.made(this._.slice(0, 3)); });
  method(SFRotation, 'setAxis', function (v) { for (var i = 0; i < 3; ++i) this[i] = v[i]; });
  method(SFRotation, 'inverse', function () {
    return plainRotation.made([this._[0], this._[1], this._[2], -this._[3]]);
  });
  method(SFRotation, 'multiply', function (o) { return rotation(product(quaternion(this), quaternion(o))); });
  method(SFRotation, 'multVec', function (v) {
    var q = quaternion(this), p = product(product(q, v._.concat(0)), [-q[0], -q[1], -q[2], q[3]]);
    return SFVec3f.made(p.slice(0, 3));
  });
  method(SFRotation, 'slerp', function (o, t) {
    var a = quaternion(this), b = quaternion(o);
    var cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
    if (cosine < 0) { b = b.map(function (x) { return -x; }); cosine = -cosine; }
    var angle = Math.acos(Math.min(1, cosine)), s = Math.sin(angle);
    var u = s > 1e-9 ? Math.sin((1 - t) * angle) / s : 1 - t, w = s > 1e-9 ? Math.sin(t * angle) / s : t;
    return rotation(a.map(function (x, i) { return u * x + w * b[i]; }));
  });

  // Nodes: what they hold is asked for when it is read.
  var nodes = {};
  var Node = function (source) {
    var made = request({op: 'create', text: text(source)}).nodes;
    if (!made.length) throw new Error('SFNode: no node in the text');
    return node(made[0]);
  };
  var nodeHandler = {
    get: function (target, key) {
      if (key === 'id_') return target.id_;
      if (key === 'toString' || key === 'getNodeName' || key === 'getNodeTypeName' || key === 'getNodeType') {
        var about = request({op: 'describe', node: target.id_});
        return function () {
          return key === 'toString' ? about.type + ' { }' : key === 'getNodeName' ? about.name
               : key === 'getNodeType' ? [about.type] : about.type;
        };
      }
      if (typeof key !== 'string' || key === 'valueOf' || key === 'toJSON') return undefined;
      var answer = request({op: 'get', node: target.id_, field: key});
      if (!answer.type) return undefined;
      var value = fromWire(answer.type, answer.value);
      own(value, function () { request({op: 'set', node: target.id_, field: key, value: toWire(value)}); });
      return value;
    },
    set: function (target, key, value) {
      request({op: 'set', node: target.id_, field: String(key), value: toWire(value)});
      return true;
    },
    has: function () { return true; }
  };
  function node(id) {
    if (id === null || id === undefined) return null;
    if (!nodes[id]) {
      var target = Object.create(Node.prototype);
      hide(target, 'id_', id);
      nodes[id] = new Proxy(target, nodeHandler);
    }
    return nodes[id];
  }
  shared.SFNode = Node;

  // MFVec3f and its like: lists that grow when something beyond their end is asked for.
  function own(value, changed) {
    if (value && typeof value === 'object' && value.id_ === undefined) value.owner_ = changed;
  }
  function list(name, of, begin) {
    var M = function (first) {
      var from = arguments.length === 1 && (Array.isArray(first) || first instanceof M) ? first : arguments;
      return M.of(from);
    };
    M.prototype = Object.create(Array.prototype);
    M.prototype.constructor = M;
    hide(M.prototype, 'toString', function () { return '[' + Array.prototype.join.call(this, ', ') + ']'; });
    M.of = function (from) {
      var elements = [], n = from && typeof from === 'object' ? from.length : 0;
      for (var i = 0; i < n; ++i) elements.push(of(from[i]));
      return M.made(elements);
    };
    M.made = function (elements) {
      Object.setPrototypeOf(elements, M.prototype);
      hide(elements, 'owner_', null);
      return new Proxy(elements, handler);
    };
    function changed(target) { if (target.owner_) target.owner_(); }
    function index(key) {
      var at = typeof key === 'number' ? key : typeof key === 'string' && key >= '0' && key < ':' ? +key : NaN;
      if (at !== at) return -1;
      if (!(at < longest)) throw new RangeError('a list of more than ' + longest + ' elements');
      return at === Math.floor(at) ? at : -1;
    }
    function grow(target, size) { while (target.length < size) target.push(begin()); }
    var handler = {
      get: function (target, key) {
        var at = index(key);
        if (at < 0) return key === 'raw_' ? target : target[key];
        if (at >= target.length) grow(target, at + 1);
        var element = target[at];
        if (element !== null && typeof element === 'object' && target.owner_) own(element, target.owner_);
        return element;
      },
      set: function (target, key, value) {
        var at = index(key);
        if (key === 'owner_') {
          target.owner_ = value;
          return true;
        }
        if (at >= 0) {
          grow(target, at);
          target[at] = of(value);
        } else if (key === 'length') {
          var size = Math.max(0, integer(value));
          if (size > longest) throw new RangeError('a list of more than ' + longest + ' elements');
          grow(target, size);
          target.length = size;
        } else
          target[key] = value;
        changed(target);
        return true;
      }
    };
    shared[name] = M;
    lists[name] = M;
  }
  Object.keys(tuples).forEach(function (name) {
    var T = tuples[name];
    list('M' + name.substr(1), function (v) { return T.of(v); }, function () { return T.of(null); });
  });
  function zero() { return 0; }
  list('MFFloat', number, zero);
  list('MFDouble', number, zero);
  list('MFTime', number, zero);
  list('MFInt32', integer, zero);
  list('MFBool', truth, function () { return false; });
  list('MFString', text, function () { return ''; });
  list('MFNode', function (v) { return v && v.id_ !== undefined ? v : null; }, function () { return null; });

  function SFImage(x, y, comp, array) {
    this.x = this.width = integer(x);
    this.y = this.height = integer(y);
    this.comp = integer(comp);
    this.array = lists.MFInt32.of(array);
  }
  shared.SFImage = SFImage;

  // Values as they travel, by the names of their types.
  function toWire(v) {
    if (v === null || v === undefined || typeof v !== 'object') return v === undefined ? null : v;
    if (v.id_ !== undefined) return v.id_;
    if (v instanceof SFImage) return [v.x, v.y, v.comp].concat(toWire(v.array));
    if (v._) return v._;
    var from = v.raw_ || v, out = [];
    if (!Array.isArray(from)) return String(v);
    for (var i = 0; i < from.length; ++i) {
      var element = toWire(from[i]);
      if (Array.isArray(element)) for (var j = 0; j < element.length; ++j) out.push(element[j]);
      else out.push(element);
    }
    return out;
  }
  function fromWire(type, v) {
    if (type === 'SFNode') return node(v);
    if (type === 'SFImage') return new SFImage(v && v[0], v && v[1], v && v[2], v && v.slice(3));
    if (tuples[type]) return tuples[type].of(v);
    if (type === 'MFNode') return lists.MFNode.of((v || []).map(node));
    if (lists[type]) {
      var T = tuples['S' + type.substr(1)];
      if (!T) return lists[type].of(v);
      var elements = [];
      for (var i = 0; v && i + T.size <= v.length; i += T.size) elements.push(T.made(v.slice(i, i + T.size)));
      return lists[type].made(elements);
    }
    return convert(type, v);
  }
  /// What a variable of that type becomes when a value is assigned to it: a copy.
  function convert(type, v) {
    switch (type) {
      case 'SFBool': return truth(v);
      case 'SFInt32': return integer(v);
      case 'SFFloat': case 'SFDouble': case 'SFTime': return v === undefined || v === null ? 0 : number(v);
      case 'SFString': return text(v);
      case 'SFNode': return v && v.id_ !== undefined ? v : null;
      case 'SFImage': return v instanceof SFImage ? new SFImage(v.x, v.y, v.comp, v.array) : new SFImage();
    }
    if (tuples[type]) return tuples[type].of(v);
    if (lists[type]) return lists[type].of(v && v.raw_ ? v.raw_ : v === null || typeof v === 'object' ? v : [v]);
    return v;
  }

  // The Browser: what asks no one outside.
  function route(op) {
    return function (from, out, to, into) {
      request({op: op, node: from && from.id_, out: text(out), to: to && to.id_, field: text(into)});
    };
  }
  function nothing() {}
  function create(source) { return lists.MFNode.of(request({op: 'create', text: text(source)}).nodes.map(node)); }
  var scene = {
    addRoute: route('route'), deleteRoute: route('unroute'),
    getNamedNode: function (name) { return node(request({op: 'named', text: text(name)}).node); },
    createNode: function (type) { return create(text(type).replace(/[^\w]/g, '') + ' { }')[0]; },
    addRootNode: function (n) { request({op: 'root', node: n && n.id_}); }
  };
  var browser = {
    name: 'wrlkit', version: '1', currentSpeed: 0, currentFrameRate: 0, currentScene: scene,
    getName: function () { return 'wrlkit'; }, getVersion: function () { return '1'; },
    getCurrentSpeed: zero, getCurrentFrameRate: zero, getWorldURL: function () { return ''; },
    createVrmlFromString: create, createX3DFromString: function (s) { return {rootNodes: create(s)}; },
    addRoute: scene.addRoute, deleteRoute: scene.deleteRoute,
    setDescription: nothing, print: nothing, println: nothing, setBrowserOption: nothing
  };
  ['loadURL', 'replaceWorld', 'createVrmlFromURL', 'createX3DFromURL', 'importDocument', 'loadURL', 'addBrowserListener']
    .forEach(function (name) { browser[name] = function () { request({op: 'refused', text: 'Browser.' + name}); }; });
  shared.Browser = browser;
  ['print', 'println', 'trace', 'alert'].forEach(function (name) { shared[name] = nothing; });
  shared.TRUE = true;
  shared.FALSE = false;
  shared.NULL = null;

  var RealDate = Date, seed = 1;
  function FixedDate(y, m, d, h, min, s, ms) {
    if (!(this instanceof FixedDate)) return new RealDate(instant * 1000).toString();
    if (arguments.length === 0) return new RealDate(instant * 1000);
    if (arguments.length === 1) return new RealDate(y);
    return new RealDate(y, m, d === undefined ? 1 : d, h || 0, min || 0, s || 0, ms || 0);
  }
  FixedDate.now = function () { return instant * 1000; };
  FixedDate.UTC = RealDate.UTC;
  FixedDate.parse = RealDate.parse;
  FixedDate.prototype = RealDate.prototype;
  if (!clock) {
    RealDate.prototype.constructor = FixedDate;
    shared.Date = FixedDate;
    Math.random = function () {
      seed = (seed * 16807) % 2147483647;
      return (seed - 1) / 2147483646;
    };
  }
  shared.Math = Math;

  // Fields are variables of the program; what becomes of eventOuts is sent when a function has ended.
  function begin(global) {
    Object.keys(shared).forEach(function (name) { hide(global, name, shared[name]); });
    delete global.Duktape;
    delete global.performance;
    var values = {}, types = {}, pending = [], isOut = {};
    function send(name) { if (isOut[name] && pending.indexOf(name) < 0) pending.push(name); }
    function declare(f) {
      types[f.name] = f.type;
      isOut[f.name] = f.out;
      var assign = function (v) {
        own(v, function () { send(f.name); });
        values[f.name] = v;
      };
      assign(fromWire(f.type, f.value));
      var names = f.inout ? [f.name, f.name + '_changed'] : [f.name];
      names.forEach(function (name) {
        Object.defineProperty(global, name, {
          configurable: true, enumerable: true,
          get: function () { return values[f.name]; },
          set: function (v) { assign(convert(f.type, v)); send(f.name); }
        });
      });
      return assign;
    }
    var assigners = {};
    return {
      load: function (json) {
        fromJson(json).fields.forEach(function (f) { assigners[f.name] = declare(f); });
      },
      call: function (json) {
        var c = fromJson(json), name = c.name, error = '';
        pending = [];
        if (c.type && assigners[c.field]) assigners[c.field](fromWire(c.type, c.value));
        try {
          var f = global[name];
          if (typeof f !== 'function' && c.field) f = global[name = c.field];
          if (typeof f === 'function') {
            if (c.type) f(fromWire(c.type, c.value), now());
            else f(now());
          }
        } catch (e) {
          error = e && e.message !== undefined ? e.name + ': ' + e.message + (e.lineNumber ? ' (line ' + e.lineNumber + ')' : '')
                                     : String(e);
        }
        return toJson({
          events: pending.map(function (n) { return {name: n, value: toWire(values[n])}; }),
          error: error
        });
      }
    };
  }
  return begin;
})
