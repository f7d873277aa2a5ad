/*! uPlot 1.6.32:
The MIT License (MIT)

Copyright (c) 2022 Leon Sorokin

Permission is hereby granted, free of charge, to any person obtaining a copy
of this software and associated documentation files (the "Software"), to deal
in the Software without restriction, including without limitation the rights
to use, copy, modify, merge, publish, distribute, sublicense, and/or sell
copies of the Software, and to permit persons to whom the Software is
furnished to do so, subject to the following conditions:

The above copyright notice and this permission notice shall be included in
all copies or substantial portions of the Software.

THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR
IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY,
FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE
AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER
LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM,
OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN
THE SOFTWARE.*/
"use strict";(()=>{function Re(t){return Float64Array.from(t)}function Ie(t,e){let n=new Float64Array(16);for(let r=0;r<16;r+=4)for(let s=0;s<4;++s)n[r+s]=t[r]*e[s]+t[r+1]*e[4+s]+t[r+2]*e[8+s]+t[r+3]*e[12+s];return n}function st(t,e=0){let[n,r,s]=[t[e],t[e+1],t[e+2]],i=Math.hypot(t[e+3],t[e+4],t[e+5],t[e+6])||1,[o,a,l,u]=[3,4,5,6].map(g=>t[e+g]/i);return Re([1-2*(l*l+u*u),2*(a*l-o*u),2*(a*u+o*l),n,2*(a*l+o*u),1-2*(a*a+u*u),2*(l*u-o*a),r,2*(a*u-o*l),2*(l*u+o*a),1-2*(a*a+l*l),s,0,0,0,1])}function Ao(t){let n=[[1,1,1],[1,-1,-1],[-1,1,-1],[-1,-1,1]].map(([g,h,p])=>Math.max(0,1+g*t[0]+h*t[5]+p*t[10])),[r,s,i,o]=n.map(g=>Math.sqrt(g)/2),a=n.indexOf(Math.max(...n)),l=[[1,t[9]-t[6],t[2]-t[8],t[4]-t[1]],[t[9]-t[6],1,t[1]+t[4],t[2]+t[8]],[t[2]-t[8],t[1]+t[4],1,t[6]+t[9]],[t[4]-t[1],t[2]+t[8],t[6]+t[9],1]],u=[r,s,i,o].map((g,h)=>g*(l[a][h]<0?-1:1));return[t[3],t[7],t[11],...u]}function ut(t){let e=n=>-(t[n]*t[3]+t[4+n]*t[7]+t[8+n]*t[11]);return Re([t[0],t[4],t[8],e(0),t[1],t[5],t[9],e(1),t[2],t[6],t[10],e(2),0,0,0,1])}function Xs(t){return he([t[0],t[1],t[2]],nt([t[4],t[5],t[6]],[t[8],t[9],t[10]]))}function To(t){let e=[0,4,8].map(o=>[t[o],t[o+1],t[o+2]]),n=1/Xs(t),[r,s,i]=[nt(e[1],e[2]),nt(e[2],e[0]),nt(e[0],e[1])];return Re([...[r,s,i].flatMap(o=>[o[0]*n,o[1]*n,o[2]*n,0]),0,0,0,1])}function Le(t,e){return[t[0]*e[0]+t[1]*e[1]+t[2]*e[2]+t[3],t[4]*e[0]+t[5]*e[1]+t[6]*e[2]+t[7],t[8]*e[0]+t[9]*e[1]+t[10]*e[2]+t[11]]}function In(t,e){return[he([t[0],t[1],t[2]],e),he([t[4],t[5],t[6]],e),he([t[8],t[9],t[10]],e)]}function Fn(t,e){return[he([t[0],t[4],t[8]],e),he([t[1],t[5],t[9]],e),he([t[2],t[6],t[10]],e)]}function Pe(t){return[t[3],t[7],t[11]]}function he(t,e){return t[0]*e[0]+t[1]*e[1]+t[2]*e[2]}function nt(t,e){return[t[1]*e[2]-t[2]*e[1],t[2]*e[0]-t[0]*e[2],t[0]*e[1]-t[1]*e[0]]}function Se(t,e,n=1){return[t[0]+n*e[0],t[1]+n*e[1],t[2]+n*e[2]]}function _t(t){let e=Math.hypot(t[0],t[1],t[2])||1;return[t[0]/e,t[1]/e,t[2]/e]}function $s(t,e,n=[0,0,1]){let r=_t(Se(t,e,-1)),s=nt(n,r);Math.hypot(...s)<1e-6&&(s=nt([1,0,0],r)),s=_t(s);let i=nt(r,s);return Re([s[0],i[0],r[0],t[0],s[1],i[1],r[1],t[1],s[2],i[2],r[2],t[2],0,0,0,1])}function Ro(t,e,n){let r=Math.min(e,.75*t)/(2*Math.tan(n/2)),s={cx:(t-1)/2,cy:(e-1)/2};return{width:t,height:e,fx:r,fy:r,...s,skew:0,near:.05,far:2e3}}function sn(t,e){let[n,r]=[Math.round(t.width*e),Math.round(t.height*e)];return{...t,width:n,height:r,fx:t.fx*e,fy:t.fy*e,cx:(t.cx+.5)*e-.5,cy:(t.cy+.5)*e-.5,skew:t.skew*e}}function Dr(t,e){let{width:n,height:r,near:s,far:i}=t,o=i-s,a=e?1:-1;return Re([2*t.fx/n,2*t.skew/n,1-(2*t.cx+1)/n,0,0,-2*a*t.fy/r,a*(1-(2*t.cy+1)/r),0,0,0,-(i+s)/o,-2*i*s/o,0,0,-1,0])}function Bt(t){return[0,1,2,3].flatMap(e=>[t[e],t[4+e],t[8+e],t[12+e]])}var Ks=class{constructor(e,n){this.head=e;this.data=n}head;data;numbers(e){let[n,r,s]=e;switch(s){case"f4":return new Float32Array(this.data,n,r);case"u4":return new Uint32Array(this.data,n,r);case"u2":return new Uint16Array(this.data,n,r);case"i2":return new Int16Array(this.data,n,r);case"i1":return new Int8Array(this.data,n,r);default:return new Uint8Array(this.data,n,r)}}};async function Po(t){let e=new Blob([t]).stream().pipeThrough(new DecompressionStream("gzip"));return new Response(e).arrayBuffer()}var Lo="0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz!#$%/()*+-;,=.?@^_`{|}~";function ko(t){let e=new Uint8Array(128);for(let s=0;s<Lo.length;++s)e[Lo.charCodeAt(s)]=s;let n=Math.ceil(t.length/5),r=new DataView(new ArrayBuffer(4*n));for(let s=0;s<n;++s){let i=0;for(let o=5*s;o<5*s+5;++o)i=85*i+(o<t.length?e[t.charCodeAt(o)]:84);r.setUint32(4*s,i)}return new Uint8Array(r.buffer,0,t.length-n)}async function on(t){let e=await Po(t),n=new DataView(e).getUint32(0,!0),r=JSON.parse(new TextDecoder().decode(new Uint8Array(e,4,n)));return new Ks(r,e.slice(4+n))}var Qs=class{constructor(e,n,r=[]){this.head=e;this.rows=n;this.removals=r}head;rows;removals;get columns(){return 7*this.head.bodies.length+this.head.signals.length}get end(){return this.head.start+Math.max(0,this.head.n-1)/this.head.rate}rowIndex(e){return Math.floor(this.rowPosition(e)+1e-6)}rowPosition(e){return Math.min(Math.max((e-this.head.start)*this.head.rate,0),this.head.n-1)}row(e){let n=this.columns,r=this.rowIndex(e),s=this.rows.slice(r*n,(r+1)*n),i=this.rowPosition(e)-r;if(i<1e-6||r+1>=this.head.n)return s;let o=(r+1)*n;for(let a=0;a<7*this.head.bodies.length;++a)s[a]+=i*(this.rows[o+a]-s[a]);return s}};async function Io(t){let e=new Uint8Array(await Po(t)),n=e.indexOf(10),r=JSON.parse(new TextDecoder().decode(e.subarray(0,n))),s=r.n,i=7*r.bodies.length+r.signals.length,o=e.subarray(n+1),a=Fo(o,s,i,l=>{let u=l%7<3?r.length:r.quaternion;return l<7*r.bodies.length?u:r.signals[l-7*r.bodies.length].step});return new Qs(r,a,vu(r,o.subarray(4*s*i)))}function Fo(t,e,n,r){let s=new Float64Array(e*n);for(let i=0;i<n;++i){let o=r(i),a=0;for(let l=0,u=i*e;l<e;++l,++u){let g=t[u]|t[e*n+u]<<8|t[2*e*n+u]<<16;a=a+(g|t[3*e*n+u]<<24)|0,s[l*n+i]=a===-2147483648?NaN:a*o}}return s}function vu({sand:t},e){if(!t)return[];let n=Fo(e,t.n,5,r=>r<2?1:t.grain);return Array.from({length:t.n},(r,s)=>{let[i,o,a,l,u]=n.subarray(5*s,5*s+5);return{row:i,heap:o,position:Number.isNaN(a)?null:[a,l,u]}})}function N(t){let e=document.getElementById(t);if(!e)throw new Error(`the page has no element ${t}`);return e}function W(t,e="",n=""){let r=document.createElement(t);return r.textContent=e,r.className=n,r}function Js(t){return t==="ok"?"ok":t==="lost"||t.includes("error")?"bad":"other"}function fr(t,e){let n=-1;return t.levels.forEach(({trial:r,level:s},i)=>{r===t.trial&&s.start<=e+1e-6&&(n=i)}),n}function Co(t){let e=t.levels.filter(({trial:n})=>n===t.trial);return e.length>0&&e.every(({level:n})=>n.status==="no motion")}var Cn=class{constructor(e,n){this.player=e;this.choose=n}player;choose;list=N("levels");current=-2;lastLevel=null;show(e){this.lastLevel!==this.player.levels.at(-1)?.level&&this.fill();let n=fr(this.player,e);if(n===this.current)return;this.current=n,this.list.querySelectorAll("button").forEach((i,o)=>{if(i.setAttribute("aria-current",String(o===n)),o!==n||this.list.contains(document.activeElement))return;let a=i.offsetTop-this.list.offsetTop;(a<this.list.scrollTop||a>this.list.scrollTop+this.list.clientHeight-24)&&(this.list.scrollTop=a-this.list.clientHeight/2)});let r=this.player.levels[n]?.level,s=N("now");s.textContent=r?`${r.label} · ${r.status}`:"",s.className=`badge ${r?Js(r.status):""}`,N("why").textContent=r?.why??"",N("why").title=r?.why??""}mark(e,n){let r=N("marks");r.replaceChildren();let s=i=>`${100*(i-e)/Math.max(n-e,1e-9)}%`;for(let{trial:i,level:o}of this.player.levels){if(i!==this.player.trial)continue;let a=W("i","",Js(o.status));a.style.left=s(o.start),a.style.width=s(e+o.end-o.start),a.title=`${o.label}: ${o.status}`,r.append(a)}}fill(){this.lastLevel=this.player.levels.at(-1)?.level,this.current=-2,N("levels-box").hidden=!this.lastLevel,this.list.replaceChildren(...this.player.levels.map(({level:e},n)=>{let r=W("button");r.append(W("span",e.label),W("span",e.status,Js(e.status))),r.title=e.why??"",r.addEventListener("click",()=>this.choose(n));let s=W("li");return s.append(r),s}))}},On=class{bars=[];constructor(e){let n=N("thrusters");for(let r of e.vehicles)for(let s of r.thrusters){let i=W("div"),[o,a,l]=[W("span","","bar"),W("i"),W("output")];o.append(a);let u=e.vehicles.length>1?`${r.name} ${s}`:s;i.append(W("span",u.replaceAll("_"," ")),o,l),n.append(i),this.bars.push({signal:`thrust/${r.name}/${s}`,bar:a,value:l})}}show(e){let n=!1;for(let{signal:r,bar:s,value:i}of this.bars){let o=e.signal(r);if(o===void 0)continue;n=!0;let a=50*Math.min(1,Math.abs(o));s.style.left=`${o<0?50-a:50}%`,s.style.width=`${a}%`,i.textContent=`${Math.round(100*o)||0} %`}N("thrusters-box").hidden=!n}};function Oo(t){let e=N("help");e.replaceChildren();let[n,r]=[W("div","","rows"),W("div","","columns")];n.tabIndex=0,n.append(r),e.append(n);for(let[i,o]of Object.entries(t)){let a=W("dl");for(let u of o)a.append(W("dt",u.keys),W("dd",u.action));let l=W("section");l.append(W("h2",i),a),r.append(l)}let s=W("button","Close");s.addEventListener("click",()=>e.close()),e.append(s)}function Nn(){let t=N("help");t.open?t.close():t.showModal()}var bu=100,yu=33,_u=["left","right"],No={surge:["forward","back"],sway:["right","left"],heave:["up","down"],yaw:["turn right","left"],roll:["roll right","left"],pitch:["pitch up","down"],lamps:["lamps brighter","darker"]},wu={yaw:"turn",sway:"left / right"},xu=6e3,Dn=class{constructor(e){this.send=e;document.addEventListener("keyup",n=>{this.pressedKeys.delete(n.key.toLowerCase()),this.poll()}),window.addEventListener("blur",()=>{this.pressedKeys.clear(),this.poll()}),setInterval(()=>this.poll(),yu)}send;isOn=!1;mapping={};reason="";names={};reservedKeys=new Set;layout="";pressedKeys=new Set;sticks=[0,0,0,0];lastText="";sendTime=0;enable(e){this.isOn=e.pilot,this.mapping=e.pilot?e.mapping:{},this.reservedKeys=new Set(e.reserved),[this.names,this.reason]=[e.names,e.why];let n=JSON.stringify([e.pilot,e.sticks,e.names,e.why]);if(n===this.layout)return;this.layout=n;let s=[..._u.map((i,o)=>this.stick(i,2*o,e.sticks.slice(2*o,2*o+2))).filter(i=>i!==null),this.reason?W("p",this.reason,"why"):this.keyHints()];N("pilot").replaceChildren(...s.filter(i=>i!==null)),N("pilot").hidden=!e.pilot}isReserved(e){return this.isOn&&this.reservedKeys.has(e)}handlePilotKey(e){let n=e.key.toLowerCase();return e.shiftKey||!this.isReserved(n)?!1:(e.preventDefault(),n in this.mapping&&(this.pressedKeys.add(n),this.poll(),this.hideKeyHints()),!0)}help(){let e=this.keyPairs();return e.length?[...e.map(({axes:r,plusKeys:s,minusKeys:i})=>({keys:`${s||"–"}  ${i||"–"}`,action:`${this.namesOf(r)} +, −`})),{keys:"Shift",action:"with a letter: the page's own key"}]:[{keys:"–",action:this.reason||"this simulation has no pilot"}]}keyPairs(){let e=new Map;for(let[n,r]of Object.entries(this.mapping)){if(!r.trim())continue;let[s,i]=Do(r),o=e.get(s)??["",""];o[i]+=(o[i]&&", ")+n,e.set(s,o)}return[...e].map(([n,[r,s]])=>({axes:n,plusKeys:r,minusKeys:s}))}namesOf(e){return e.split(" ").map(n=>{let r=this.names[n.replace("-","")];return r?n.replace(/[a-z]+\d*/,r):n}).join(" ")}keyHints(){let e=this.keyPairs();if(!e.length)return null;let n=W("div","","keyline");for(let{axes:i,plusKeys:o,minusKeys:a}of e){let l=W("span"),u=No[i]?.join(" / ")??this.namesOf(i);for(let g of[o,a])g&&l.append(W("kbd",g.toUpperCase()));l.append(` ${u}`),n.append(l)}let r=W("span");r.append(W("kbd","?")," all keys");let s=W("button","×");return s.setAttribute("aria-label","Hide the line of keys"),s.addEventListener("click",()=>n.remove()),n.append(r,s),n}hideKeyHints(){let e=N("pilot").querySelector(".keyline");e&&!e.classList.contains("leaves")&&(e.classList.add("leaves"),setTimeout(()=>e.remove(),xu))}input(){let e=navigator.getGamepads?.().find(n=>n!==null);return{keys:[...this.pressedKeys].sort(),axes:e?e.axes.map(Zs):[],buttons:e?e.buttons.map(({value:n})=>Zs(n)):[],sticks:this.sticks.map(Zs)}}poll(){if(!this.isOn)return;let e=this.input(),n=JSON.stringify(e),r=performance.now(),s=!e.keys.length&&![...e.axes,...e.buttons,...e.sticks].some(Boolean);if(n===this.lastText&&(s||r-this.sendTime<bu))return;let i=n!==this.lastText;this.lastText=n,this.sendTime=r,this.send({type:"input",...e},i)}stick(e,n,r){if(!r.some(h=>h.trim()))return null;let[s,i]=[W("div","",`thumb ${e}`),W("div","","label")],o=["↔","↕"];r.forEach((h,p)=>{h.trim()&&i.prepend(W("span",`${o[p]} ${this.stickWords(h)}`))});let[a,l]=[W("div","","stick"),W("i")];a.title=i.innerText,a.append(l),s.append(i,a);let u=(h,p)=>{let b=Math.max(1,Math.hypot(h,p));this.sticks[n]=h/b,this.sticks[n+1]=p/b,l.style.transform=`translate(${35*h/b}px, ${-35*p/b}px)`,this.poll()},g=h=>{if(!a.hasPointerCapture(h.pointerId))return;let p=a.getBoundingClientRect(),b=p.width/2;u((h.clientX-p.left-b)/b,-(h.clientY-p.top-b)/b)};a.addEventListener("pointerdown",h=>{a.setPointerCapture(h.pointerId),g(h)}),a.addEventListener("pointermove",g);for(let h of["pointerup","pointercancel"])a.addEventListener(h,()=>u(0,0));return s}stickWords(e){let[n]=Do(e);return wu[n]??No[n]?.join(" / ")??this.namesOf(n)}};function Do(t){let e=t.trim().split(/\s+/),n=e[0].startsWith("-");return[e.map(s=>(s.startsWith("-")!==n?"-":"")+s.replace(/^[+-]+/,"")).join(" "),n?1:0]}function Zs(t){return Math.round(t*1e3)/1e3}var Eu="uplot",Su="u-hz",Mu="u-vt",Au="u-title",Tu="u-wrap",Ru="u-under",Lu="u-over",Pu="u-axis",mr="u-off",ku="u-select",Iu="u-cursor-x",Fu="u-cursor-y",Cu="u-cursor-pt",Ou="u-legend",Nu="u-live",Du="u-inline",Hu="u-series",Uu="u-marker",Ho="u-label",Gu="u-value",ln="width",cn="height";var Uo="bottom",Hr="left",ei="right",vi="#000",Go=vi+"0",ti="mousemove",Vo="mousedown",ri="mouseup",zo="mouseenter",Bo="mouseleave",Wo="dblclick",Vu="resize",zu="scroll",jo="change",zn="dppxchange",bi="--",jr=typeof window<"u",ai=jr?document:null,Gr=jr?window:null,Bu=jr?navigator:null,ae,Hn;function li(){let t=devicePixelRatio;ae!=t&&(ae=t,Hn&&ui(jo,Hn,li),Hn=matchMedia(`(min-resolution: ${ae-.001}dppx) and (max-resolution: ${ae+.001}dppx)`),pr(jo,Hn,li),Gr.dispatchEvent(new CustomEvent(zn)))}function ft(t,e){if(e!=null){let n=t.classList;!n.contains(e)&&n.add(e)}}function ci(t,e){let n=t.classList;n.contains(e)&&n.remove(e)}function _e(t,e,n){t.style[e]=n+"px"}function Rt(t,e,n,r){let s=ai.createElement(t);return e!=null&&ft(s,e),n?.insertBefore(s,r),s}function wt(t,e){return Rt("div",t,e)}var Yo=new WeakMap;function Ut(t,e,n,r,s){let i="translate("+e+"px,"+n+"px)",o=Yo.get(t);i!=o&&(t.style.transform=i,Yo.set(t,i),e<0||n<0||e>r||n>s?ft(t,mr):ci(t,mr))}var qo=new WeakMap;function Xo(t,e,n){let r=e+n,s=qo.get(t);r!=s&&(qo.set(t,r),t.style.background=e,t.style.borderColor=n)}var $o=new WeakMap;function Ko(t,e,n,r){let s=e+""+n,i=$o.get(t);s!=i&&($o.set(t,s),t.style.height=n+"px",t.style.width=e+"px",t.style.marginLeft=r?-e/2+"px":0,t.style.marginTop=r?-n/2+"px":0)}var yi={passive:!0},Wu={...yi,capture:!0};function pr(t,e,n,r){e.addEventListener(t,n,r?Wu:yi)}function ui(t,e,n,r){e.removeEventListener(t,n,yi)}jr&&li();function Lt(t,e,n,r){let s;n=n||0,r=r||e.length-1;let i=r<=2147483647;for(;r-n>1;)s=i?n+r>>1:ht((n+r)/2),e[s]<t?n=s:r=s;return t-e[n]<=e[r]-t?n:r}function Sa(t){return(n,r,s)=>{let i=-1,o=-1;for(let a=r;a<=s;a++)if(t(n[a])){i=a;break}for(let a=s;a>=r;a--)if(t(n[a])){o=a;break}return[i,o]}}var Ma=t=>t!=null,Aa=t=>t!=null&&t>0,jn=Sa(Ma),ju=Sa(Aa);function Yu(t,e,n,r=0,s=!1){let i=s?ju:jn,o=s?Aa:Ma;[e,n]=i(t,e,n);let a=t[e],l=t[e];if(e>-1)if(r==1)a=t[e],l=t[n];else if(r==-1)a=t[n],l=t[e];else for(let u=e;u<=n;u++){let g=t[u];o(g)&&(g<a?a=g:g>l&&(l=g))}return[a??de,l??-de]}function Yn(t,e,n,r){let s=Zo(t),i=Zo(e);t==e&&(s==-1?(t*=n,e/=n):(t/=n,e*=n));let o=n==10?Wt:Ta,a=s==1?ht:xt,l=i==1?xt:ht,u=a(o(De(t))),g=l(o(De(e))),h=Vr(n,u),p=Vr(n,g);return n==10&&(u<0&&(h=me(h,-u)),g<0&&(p=me(p,-g))),r||n==2?(t=h*s,e=p*i):(t=ka(t,h),e=qn(e,p)),[t,e]}function _i(t,e,n,r){let s=Yn(t,e,n,r);return t==0&&(s[0]=0),e==0&&(s[1]=0),s}var wi=.1,Qo={mode:3,pad:wi},fn={pad:0,soft:null,mode:0},qu={min:fn,max:fn};function Bn(t,e,n,r){return Xn(n)?Jo(t,e,n):(fn.pad=n,fn.soft=r?0:null,fn.mode=r?3:0,Jo(t,e,qu))}function ie(t,e){return t??e}function Xu(t,e,n){for(e=ie(e,0),n=ie(n,t.length-1);e<=n;){if(t[e]!=null)return!0;e++}return!1}function Jo(t,e,n){let r=n.min,s=n.max,i=ie(r.pad,0),o=ie(s.pad,0),a=ie(r.hard,-de),l=ie(s.hard,de),u=ie(r.soft,de),g=ie(s.soft,-de),h=ie(r.mode,0),p=ie(s.mode,0),b=e-t,_=Wt(b),w=Ze(De(t),De(e)),A=Wt(w),L=De(A-_);(b<1e-24||L>10)&&(b=0,(t==0||e==0)&&(b=1e-24,h==2&&u!=de&&(i=0),p==2&&g!=-de&&(o=0)));let E=b||w||1e3,R=Wt(E),M=Vr(10,ht(R)),X=E*(b==0?t==0?.1:1:i),k=me(ka(t-X,M/10),24),z=t>=u&&(h==1||h==3&&k<=u||h==2&&k>=u)?u:de,B=Ze(a,k<z&&t>=z?z:Pt(z,k)),K=E*(b==0?e==0?.1:1:o),q=me(qn(e+K,M/10),24),P=e<=g&&(p==1||p==3&&q>=g||p==2&&q<=g)?g:-de,Q=Pt(l,q>P&&e<=P?P:Ze(P,q));return B==Q&&B==0&&(Q=100),[B,Q]}var $u=new Intl.NumberFormat(jr?Bu.language:"en-US"),xi=t=>$u.format(t),dt=Math,Vn=dt.PI,De=dt.abs,ht=dt.floor,Ne=dt.round,xt=dt.ceil,Pt=dt.min,Ze=dt.max,Vr=dt.pow,Zo=dt.sign,Wt=dt.log10,Ta=dt.log2,Ku=(t,e=1)=>dt.sinh(t)*e,ni=(t,e=1)=>dt.asinh(t/e),de=1/0;function ea(t){return(Wt((t^t>>31)-(t>>31))|0)+1}function fi(t,e,n){return Pt(Ze(t,e),n)}function Ra(t){return typeof t=="function"}function re(t){return Ra(t)?t:()=>t}var Qu=()=>{},La=t=>t,Pa=(t,e)=>e,Ju=t=>null,ta=t=>!0,ra=(t,e)=>t==e,Zu=/\.\d*?(?=9{6,}|0{6,})/gm,gr=t=>{if(Fa(t)||Zt.has(t))return t;let e=`${t}`,n=e.match(Zu);if(n==null)return t;let r=n[0].length-1;if(e.indexOf("e-")!=-1){let[s,i]=e.split("e");return+`${gr(s)}e${i}`}return me(t,r)};function hr(t,e){return gr(me(gr(t/e))*e)}function qn(t,e){return gr(xt(gr(t/e))*e)}function ka(t,e){return gr(ht(gr(t/e))*e)}function me(t,e=0){if(Fa(t))return t;let n=10**e,r=t*n*(1+Number.EPSILON);return Ne(r)/n}var Zt=new Map;function Ia(t){return((""+t).split(".")[1]||"").length}function dn(t,e,n,r){let s=[],i=r.map(Ia);for(let o=e;o<n;o++){let a=De(o),l=me(Vr(t,o),a);for(let u=0;u<r.length;u++){let g=t==10?+`${r[u]}e${o}`:r[u]*l,h=(o>=0?0:a)+(o>=i[u]?0:i[u]),p=t==10?g:me(g,h);s.push(p),Zt.set(p,h)}}return s}var hn={},Ei=[],zr=[null,null],Jt=Array.isArray,Fa=Number.isInteger,ef=t=>t===void 0;function na(t){return typeof t=="string"}function Xn(t){let e=!1;if(t!=null){let n=t.constructor;e=n==null||n==Object}return e}function tf(t){return t!=null&&typeof t=="object"}var rf=Object.getPrototypeOf(Uint8Array),Ca="__proto__";function Br(t,e=Xn){let n;if(Jt(t)){let r=t.find(s=>s!=null);if(Jt(r)||e(r)){n=Array(t.length);for(let s=0;s<t.length;s++)n[s]=Br(t[s],e)}else n=t.slice()}else if(t instanceof rf)n=t.slice();else if(e(t)){n={};for(let r in t)r!=Ca&&(n[r]=Br(t[r],e))}else n=t;return n}function Fe(t){let e=arguments;for(let n=1;n<e.length;n++){let r=e[n];for(let s in r)s!=Ca&&(Xn(t[s])?Fe(t[s],Br(r[s])):t[s]=Br(r[s]))}return t}var nf=0,sf=1,of=2;function af(t,e,n){for(let r=0,s,i=-1;r<e.length;r++){let o=e[r];if(o>i){for(s=o-1;s>=0&&t[s]==null;)t[s--]=null;for(s=o+1;s<n&&t[s]==null;)t[i=s++]=null}}}function lf(t,e){if(ff(t)){let o=t[0].slice();for(let a=1;a<t.length;a++)o.push(...t[a].slice(1));return hf(o[0])||(o=uf(o)),o}let n=new Set;for(let o=0;o<t.length;o++){let l=t[o][0],u=l.length;for(let g=0;g<u;g++)n.add(l[g])}let r=[Array.from(n).sort((o,a)=>o-a)],s=r[0].length,i=new Map;for(let o=0;o<s;o++)i.set(r[0][o],o);for(let o=0;o<t.length;o++){let a=t[o],l=a[0];for(let u=1;u<a.length;u++){let g=a[u],h=Array(s).fill(void 0),p=e?e[o][u]:sf,b=[];for(let _=0;_<g.length;_++){let w=g[_],A=i.get(l[_]);w===null?p!=nf&&(h[A]=w,p==of&&b.push(A)):h[A]=w}af(h,b,s),r.push(h)}}return r}var cf=typeof queueMicrotask>"u"?t=>Promise.resolve().then(t):queueMicrotask;function uf(t){let e=t[0],n=e.length,r=Array(n);for(let i=0;i<r.length;i++)r[i]=i;r.sort((i,o)=>e[i]-e[o]);let s=[];for(let i=0;i<t.length;i++){let o=t[i],a=Array(n);for(let l=0;l<n;l++)a[l]=o[r[l]];s.push(a)}return s}function ff(t){let e=t[0][0],n=e.length;for(let r=1;r<t.length;r++){let s=t[r][0];if(s.length!=n)return!1;if(s!=e){for(let i=0;i<n;i++)if(s[i]!=e[i])return!1}}return!0}function hf(t,e=100){let n=t.length;if(n<=1)return!0;let r=0,s=n-1;for(;r<=s&&t[r]==null;)r++;for(;s>=r&&t[s]==null;)s--;if(s<=r)return!0;let i=Ze(1,ht((s-r+1)/e));for(let o=t[r],a=r+i;a<=s;a+=i){let l=t[a];if(l!=null){if(l<=o)return!1;o=l}}return!0}var Oa=["January","February","March","April","May","June","July","August","September","October","November","December"],Na=["Sunday","Monday","Tuesday","Wednesday","Thursday","Friday","Saturday"];function Da(t){return t.slice(0,3)}var df=Na.map(Da),mf=Oa.map(Da),pf={MMMM:Oa,MMM:mf,WWWW:Na,WWW:df};function an(t){return(t<10?"0":"")+t}function gf(t){return(t<10?"00":t<100?"0":"")+t}var vf={YYYY:t=>t.getFullYear(),YY:t=>(t.getFullYear()+"").slice(2),MMMM:(t,e)=>e.MMMM[t.getMonth()],MMM:(t,e)=>e.MMM[t.getMonth()],MM:t=>an(t.getMonth()+1),M:t=>t.getMonth()+1,DD:t=>an(t.getDate()),D:t=>t.getDate(),WWWW:(t,e)=>e.WWWW[t.getDay()],WWW:(t,e)=>e.WWW[t.getDay()],HH:t=>an(t.getHours()),H:t=>t.getHours(),h:t=>{let e=t.getHours();return e==0?12:e>12?e-12:e},AA:t=>t.getHours()>=12?"PM":"AM",aa:t=>t.getHours()>=12?"pm":"am",a:t=>t.getHours()>=12?"p":"a",mm:t=>an(t.getMinutes()),m:t=>t.getMinutes(),ss:t=>an(t.getSeconds()),s:t=>t.getSeconds(),fff:t=>gf(t.getMilliseconds())};function Si(t,e){e=e||pf;let n=[],r=/\{([a-z]+)\}|[^{]+/gi,s;for(;s=r.exec(t);)n.push(s[0][0]=="{"?vf[s[1]]:s[0]);return i=>{let o="";for(let a=0;a<n.length;a++)o+=typeof n[a]=="string"?n[a]:n[a](i,e);return o}}var bf=new Intl.DateTimeFormat().resolvedOptions().timeZone;function yf(t,e){let n;return e=="UTC"||e=="Etc/UTC"?n=new Date(+t+t.getTimezoneOffset()*6e4):e==bf?n=t:(n=new Date(t.toLocaleString("en-US",{timeZone:e})),n.setMilliseconds(t.getMilliseconds())),n}var Ha=t=>t%1==0,Wn=[1,2,2.5,5],_f=dn(10,-32,0,Wn),Ua=dn(10,0,32,Wn),wf=Ua.filter(Ha),dr=_f.concat(Ua),Mi=`
`,Ga="{YYYY}",sa=Mi+Ga,Va="{M}/{D}",un=Mi+Va,Un=un+"/{YY}",za="{aa}",xf="{h}:{mm}",Ur=xf+za,ia=Mi+Ur,oa=":{ss}",ce=null;function Ba(t){let e=t*1e3,n=e*60,r=n*60,s=r*24,i=s*30,o=s*365,l=(t==1?dn(10,0,3,Wn).filter(Ha):dn(10,-3,0,Wn)).concat([e,e*5,e*10,e*15,e*30,n,n*5,n*10,n*15,n*30,r,r*2,r*3,r*4,r*6,r*8,r*12,s,s*2,s*3,s*4,s*5,s*6,s*7,s*8,s*9,s*10,s*15,i,i*2,i*3,i*4,i*6,o,o*2,o*5,o*10,o*25,o*50,o*100]),u=[[o,Ga,ce,ce,ce,ce,ce,ce,1],[s*28,"{MMM}",sa,ce,ce,ce,ce,ce,1],[s,Va,sa,ce,ce,ce,ce,ce,1],[r,"{h}"+za,Un,ce,un,ce,ce,ce,1],[n,Ur,Un,ce,un,ce,ce,ce,1],[e,oa,Un+" "+Ur,ce,un+" "+Ur,ce,ia,ce,1],[t,oa+".{fff}",Un+" "+Ur,ce,un+" "+Ur,ce,ia,ce,1]];function g(h){return(p,b,_,w,A,L)=>{let E=[],R=A>=o,M=A>=i&&A<o,X=h(_),k=me(X*t,3),z=si(X.getFullYear(),R?0:X.getMonth(),M||R?1:X.getDate()),B=me(z*t,3);if(M||R){let K=M?A/i:0,q=R?A/o:0,P=k==B?k:me(si(z.getFullYear()+q,z.getMonth()+K,1)*t,3),Q=new Date(Ne(P/t)),D=Q.getFullYear(),Y=Q.getMonth();for(let H=0;P<=w;H++){let Z=si(D+q*H,Y+K*H,1),V=Z-h(me(Z*t,3));P=me((+Z+V)*t,3),P<=w&&E.push(P)}}else{let K=A>=s?s:A,q=ht(_)-ht(k),P=B+q+qn(k-B,K);E.push(P);let Q=h(P),D=Q.getHours()+Q.getMinutes()/n+Q.getSeconds()/r,Y=A/r,H=p.axes[b]._space,Z=L/H;for(;P=me(P+A,t==1?0:3),!(P>w);)if(Y>1){let V=ht(me(D+Y,6))%24,ne=h(P).getHours()-V;ne>1&&(ne=-1),P-=ne*r,D=(D+Y)%24;let ue=E[E.length-1];me((P-ue)/A,3)*Z>=.7&&E.push(P)}else E.push(P)}return E}}return[l,u,g]}var[Ef,Sf,Mf]=Ba(1),[Af,Tf,Rf]=Ba(.001);dn(2,-53,53,[1]);function aa(t,e){return t.map(n=>n.map((r,s)=>s==0||s==8||r==null?r:e(s==1||n[8]==0?r:n[1]+r)))}function la(t,e){return(n,r,s,i,o)=>{let a=e.find(_=>o>=_[0])||e[e.length-1],l,u,g,h,p,b;return r.map(_=>{let w=t(_),A=w.getFullYear(),L=w.getMonth(),E=w.getDate(),R=w.getHours(),M=w.getMinutes(),X=w.getSeconds(),k=A!=l&&a[2]||L!=u&&a[3]||E!=g&&a[4]||R!=h&&a[5]||M!=p&&a[6]||X!=b&&a[7]||a[1];return l=A,u=L,g=E,h=R,p=M,b=X,k(w)})}}function Lf(t,e){let n=Si(e);return(r,s,i,o,a)=>s.map(l=>n(t(l)))}function si(t,e,n){return new Date(t,e,n)}function ca(t,e){return e(t)}var Pf="{YYYY}-{MM}-{DD} {h}:{mm}{aa}";function ua(t,e){return(n,r,s,i)=>i==null?bi:e(t(r))}function kf(t,e){let n=t.series[e];return n.width?n.stroke(t,e):n.points.width?n.points.stroke(t,e):null}function If(t,e){return t.series[e].fill(t,e)}var Ff={show:!0,live:!0,isolate:!1,mount:Qu,markers:{show:!0,width:2,stroke:kf,fill:If,dash:"solid"},idx:null,idxs:null,values:[]};function Cf(t,e){let n=t.cursor.points,r=wt(),s=n.size(t,e);_e(r,ln,s),_e(r,cn,s);let i=s/-2;_e(r,"marginLeft",i),_e(r,"marginTop",i);let o=n.width(t,e,s);return o&&_e(r,"borderWidth",o),r}function Of(t,e){let n=t.series[e].points;return n._fill||n._stroke}function Nf(t,e){let n=t.series[e].points;return n._stroke||n._fill}function Df(t,e){return t.series[e].points.size}var ii=[0,0];function Hf(t,e,n){return ii[0]=e,ii[1]=n,ii}function Gn(t,e,n,r=!0){return s=>{s.button==0&&(!r||s.target==e)&&n(s)}}function oi(t,e,n,r=!0){return s=>{(!r||s.target==e)&&n(s)}}var Uf={show:!0,x:!0,y:!0,lock:!1,move:Hf,points:{one:!1,show:Cf,size:Df,width:0,stroke:Nf,fill:Of},bind:{mousedown:Gn,mouseup:Gn,click:Gn,dblclick:Gn,mousemove:oi,mouseleave:oi,mouseenter:oi},drag:{setScale:!0,x:!0,y:!1,dist:0,uni:null,click:(t,e)=>{e.stopPropagation(),e.stopImmediatePropagation()},_x:!1,_y:!1},focus:{dist:(t,e,n,r,s)=>r-s,prox:-1,bias:0},hover:{skip:[void 0],prox:null,bias:0},left:-10,top:-10,idx:null,dataIdx:null,idxs:null,event:null},Wa={show:!0,stroke:"rgba(0,0,0,0.07)",width:2},Ai=Fe({},Wa,{filter:Pa}),ja=Fe({},Ai,{size:10}),Ya=Fe({},Wa,{show:!1}),Ti='12px system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, "Noto Sans", sans-serif, "Apple Color Emoji", "Segoe UI Emoji", "Segoe UI Symbol", "Noto Color Emoji"',qa="bold "+Ti,Xa=1.5,fa={show:!0,scale:"x",stroke:vi,space:50,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:qa,side:2,grid:Ai,ticks:ja,border:Ya,font:Ti,lineGap:Xa,rotate:0},Gf="Value",Vf="Time",ha={show:!0,scale:"x",auto:!1,sorted:1,min:de,max:-de,idxs:[]};function zf(t,e,n,r,s){return e.map(i=>i==null?"":xi(i))}function Bf(t,e,n,r,s,i,o){let a=[],l=Zt.get(s)||0;n=o?n:me(qn(n,s),l);for(let u=n;u<=r;u=me(u+s,l))a.push(Object.is(u,-0)?0:u);return a}function hi(t,e,n,r,s,i,o){let a=[],l=t.scales[t.axes[e].scale].log,u=l==10?Wt:Ta,g=ht(u(n));s=Vr(l,g),l==10&&(s=dr[Lt(s,dr)]);let h=n,p=s*l;l==10&&(p=dr[Lt(p,dr)]);do a.push(h),h=h+s,l==10&&!Zt.has(h)&&(h=me(h,Zt.get(s))),h>=p&&(s=h,p=s*l,l==10&&(p=dr[Lt(p,dr)]));while(h<=r);return a}function Wf(t,e,n,r,s,i,o){let l=t.scales[t.axes[e].scale].asinh,u=r>l?hi(t,e,Ze(l,n),r,s):[l],g=r>=0&&n<=0?[0]:[];return(n<-l?hi(t,e,Ze(l,-r),-n,s):[l]).reverse().map(p=>-p).concat(g,u)}var $a=/./,jf=/[12357]/,Yf=/[125]/,da=/1/,di=(t,e,n,r)=>t.map((s,i)=>e==4&&s==0||i%r==0&&n.test(s.toExponential()[s<0?1:0])?s:null);function qf(t,e,n,r,s){let i=t.axes[n],o=i.scale,a=t.scales[o],l=t.valToPos,u=i._space,g=l(10,o),h=l(9,o)-g>=u?$a:l(7,o)-g>=u?jf:l(5,o)-g>=u?Yf:da;if(h==da){let p=De(l(1,o)-g);if(p<u)return di(e.slice().reverse(),a.distr,h,xt(u/p)).reverse()}return di(e,a.distr,h,1)}function Xf(t,e,n,r,s){let i=t.axes[n],o=i.scale,a=i._space,l=t.valToPos,u=De(l(1,o)-l(2,o));return u<a?di(e.slice().reverse(),3,$a,xt(a/u)).reverse():e}function $f(t,e,n,r){return r==null?bi:e==null?"":xi(e)}var ma={show:!0,scale:"y",stroke:vi,space:30,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:qa,side:3,grid:Ai,ticks:ja,border:Ya,font:Ti,lineGap:Xa,rotate:0};function Kf(t,e){let n=3+(t||1)*2;return me(n*e,3)}function Qf(t,e){let{scale:n,idxs:r}=t.series[0],s=t._data[0],i=t.valToPos(s[r[0]],n,!0),o=t.valToPos(s[r[1]],n,!0),a=De(o-i),l=t.series[e],u=a/(l.points.space*ae);return r[1]-r[0]<=u}var pa={scale:null,auto:!0,sorted:0,min:de,max:-de},Ka=(t,e,n,r,s)=>s,ga={show:!0,auto:!0,sorted:0,gaps:Ka,alpha:1,facets:[Fe({},pa,{scale:"x"}),Fe({},pa,{scale:"y"})]},va={scale:"y",auto:!0,sorted:0,show:!0,spanGaps:!1,gaps:Ka,alpha:1,points:{show:Qf,filter:null},values:null,min:de,max:-de,idxs:[],path:null,clip:null};function Jf(t,e,n,r,s){return n/10}var Qa={time:!0,auto:!0,distr:1,log:10,asinh:1,min:null,max:null,dir:1,ori:0},Zf=Fe({},Qa,{time:!1,ori:1}),ba={};function Ja(t,e){let n=ba[t];return n||(n={key:t,plots:[],sub(r){n.plots.push(r)},unsub(r){n.plots=n.plots.filter(s=>s!=r)},pub(r,s,i,o,a,l,u){for(let g=0;g<n.plots.length;g++)n.plots[g]!=s&&n.plots[g].pub(r,s,i,o,a,l,u)}},t!=null&&(ba[t]=n)),n}var Wr=1,mi=2;function vr(t,e,n){let r=t.mode,s=t.series[e],i=r==2?t._data[e]:t._data,o=t.scales,a=t.bbox,l=i[0],u=r==2?i[1]:i[e],g=r==2?o[s.facets[0].scale]:o[t.series[0].scale],h=r==2?o[s.facets[1].scale]:o[s.scale],p=a.left,b=a.top,_=a.width,w=a.height,A=t.valToPosH,L=t.valToPosV;return g.ori==0?n(s,l,u,g,h,A,L,p,b,_,w,Kn,Yr,Jn,el,rl):n(s,l,u,g,h,L,A,b,p,w,_,Qn,qr,Pi,tl,nl)}function Ri(t,e){let n=0,r=0,s=ie(t.bands,Ei);for(let i=0;i<s.length;i++){let o=s[i];o.series[0]==e?n=o.dir:o.series[1]==e&&(o.dir==1?r|=1:r|=2)}return[n,r==1?-1:r==2?1:r==3?2:0]}function eh(t,e,n,r,s){let i=t.mode,o=t.series[e],a=i==2?o.facets[1].scale:o.scale,l=t.scales[a];return s==-1?l.min:s==1?l.max:l.distr==3?l.dir==1?l.min:l.max:0}function jt(t,e,n,r,s,i){return vr(t,e,(o,a,l,u,g,h,p,b,_,w,A)=>{let L=o.pxRound,E=u.dir*(u.ori==0?1:-1),R=u.ori==0?Yr:qr,M,X;E==1?(M=n,X=r):(M=r,X=n);let k=L(h(a[M],u,w,b)),z=L(p(l[M],g,A,_)),B=L(h(a[X],u,w,b)),K=L(p(i==1?g.max:g.min,g,A,_)),q=new Path2D(s);return R(q,B,K),R(q,k,K),R(q,k,z),q})}function $n(t,e,n,r,s,i){let o=null;if(t.length>0){o=new Path2D;let a=e==0?Jn:Pi,l=n;for(let h=0;h<t.length;h++){let p=t[h];if(p[1]>p[0]){let b=p[0]-l;b>0&&a(o,l,r,b,r+i),l=p[1]}}let u=n+s-l,g=10;u>0&&a(o,l,r-g/2,u,r+i+g)}return o}function th(t,e,n){let r=t[t.length-1];r&&r[0]==e?r[1]=n:t.push([e,n])}function Li(t,e,n,r,s,i,o){let a=[],l=t.length;for(let u=s==1?n:r;u>=n&&u<=r;u+=s)if(e[u]===null){let h=u,p=u;if(s==1)for(;++u<=r&&e[u]===null;)p=u;else for(;--u>=n&&e[u]===null;)p=u;let b=i(t[h]),_=p==h?b:i(t[p]),w=h-s;b=o<=0&&w>=0&&w<l?i(t[w]):b;let L=p+s;_=o>=0&&L>=0&&L<l?i(t[L]):_,_>=b&&a.push([b,_])}return a}function ya(t){return t==0?La:t==1?Ne:e=>hr(e,t)}function Za(t){let e=t==0?Kn:Qn,n=t==0?(s,i,o,a,l,u)=>{s.arcTo(i,o,a,l,u)}:(s,i,o,a,l,u)=>{s.arcTo(o,i,l,a,u)},r=t==0?(s,i,o,a,l)=>{s.rect(i,o,a,l)}:(s,i,o,a,l)=>{s.rect(o,i,l,a)};return(s,i,o,a,l,u=0,g=0)=>{u==0&&g==0?r(s,i,o,a,l):(u=Pt(u,a/2,l/2),g=Pt(g,a/2,l/2),e(s,i+u,o),n(s,i+a,o,i+a,o+l,u),n(s,i+a,o+l,i,o+l,g),n(s,i,o+l,i,o,g),n(s,i,o,i+a,o,u),s.closePath())}}var Kn=(t,e,n)=>{t.moveTo(e,n)},Qn=(t,e,n)=>{t.moveTo(n,e)},Yr=(t,e,n)=>{t.lineTo(e,n)},qr=(t,e,n)=>{t.lineTo(n,e)},Jn=Za(0),Pi=Za(1),el=(t,e,n,r,s,i)=>{t.arc(e,n,r,s,i)},tl=(t,e,n,r,s,i)=>{t.arc(n,e,r,s,i)},rl=(t,e,n,r,s,i,o)=>{t.bezierCurveTo(e,n,r,s,i,o)},nl=(t,e,n,r,s,i,o)=>{t.bezierCurveTo(n,e,s,r,o,i)};function sl(t){return(e,n,r,s,i)=>vr(e,n,(o,a,l,u,g,h,p,b,_,w,A)=>{let{pxRound:L,points:E}=o,R,M;u.ori==0?(R=Kn,M=el):(R=Qn,M=tl);let X=me(E.width*ae,3),k=(E.size-E.width)/2*ae,z=me(k*2,3),B=new Path2D,K=new Path2D,{left:q,top:P,width:Q,height:D}=e.bbox;Jn(K,q-z,P-z,Q+z*2,D+z*2);let Y=H=>{if(l[H]!=null){let Z=L(h(a[H],u,w,b)),V=L(p(l[H],g,A,_));R(B,Z+k,V),M(B,Z,V,k,0,Vn*2)}};if(i)i.forEach(Y);else for(let H=r;H<=s;H++)Y(H);return{stroke:X>0?B:null,fill:B,clip:K,flags:Wr|mi}})}function il(t){return(e,n,r,s,i,o)=>{r!=s&&(i!=r&&o!=r&&t(e,n,r),i!=s&&o!=s&&t(e,n,s),t(e,n,o))}}var rh=il(Yr),nh=il(qr);function ol(t){let e=ie(t?.alignGaps,0);return(n,r,s,i)=>vr(n,r,(o,a,l,u,g,h,p,b,_,w,A)=>{[s,i]=jn(l,s,i);let L=o.pxRound,E=D=>L(h(D,u,w,b)),R=D=>L(p(D,g,A,_)),M,X;u.ori==0?(M=Yr,X=rh):(M=qr,X=nh);let k=u.dir*(u.ori==0?1:-1),z={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:Wr},B=z.stroke,K=!1;if(i-s>=w*4){let D=U=>n.posToVal(U,u.key,!0),Y=null,H=null,Z,V,et,we=E(a[k==1?s:i]),ne=E(a[s]),ue=E(a[i]),ee=D(k==1?ne+1:ue-1);for(let U=k==1?s:i;U>=s&&U<=i;U+=k){let Ce=a[U],xe=(k==1?Ce<ee:Ce>ee)?we:E(Ce),le=l[U];xe==we?le!=null?(V=le,Y==null?(M(B,xe,R(V)),Z=Y=H=V):V<Y?Y=V:V>H&&(H=V)):le===null&&(K=!0):(Y!=null&&X(B,we,R(Y),R(H),R(Z),R(V)),le!=null?(V=le,M(B,xe,R(V)),Y=H=Z=V):(Y=H=null,le===null&&(K=!0)),we=xe,ee=D(we+k))}Y!=null&&Y!=H&&et!=we&&X(B,we,R(Y),R(H),R(Z),R(V))}else for(let D=k==1?s:i;D>=s&&D<=i;D+=k){let Y=l[D];Y===null?K=!0:Y!=null&&M(B,E(a[D]),R(Y))}let[P,Q]=Ri(n,r);if(o.fill!=null||P!=0){let D=z.fill=new Path2D(B),Y=o.fillTo(n,r,o.min,o.max,P),H=R(Y),Z=E(a[s]),V=E(a[i]);k==-1&&([V,Z]=[Z,V]),M(D,V,H),M(D,Z,H)}if(!o.spanGaps){let D=[];K&&D.push(...Li(a,l,s,i,k,E,e)),z.gaps=D=o.gaps(n,r,s,i,D),z.clip=$n(D,u.ori,b,_,w,A)}return Q!=0&&(z.band=Q==2?[jt(n,r,s,i,B,-1),jt(n,r,s,i,B,1)]:jt(n,r,s,i,B,Q)),z})}function sh(t){let e=ie(t.align,1),n=ie(t.ascDesc,!1),r=ie(t.alignGaps,0),s=ie(t.extend,!1);return(i,o,a,l)=>vr(i,o,(u,g,h,p,b,_,w,A,L,E,R)=>{[a,l]=jn(h,a,l);let M=u.pxRound,{left:X,width:k}=i.bbox,z=ne=>M(_(ne,p,E,A)),B=ne=>M(w(ne,b,R,L)),K=p.ori==0?Yr:qr,q={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:Wr},P=q.stroke,Q=p.dir*(p.ori==0?1:-1),D=B(h[Q==1?a:l]),Y=z(g[Q==1?a:l]),H=Y,Z=Y;s&&e==-1&&(Z=X,K(P,Z,D)),K(P,Y,D);for(let ne=Q==1?a:l;ne>=a&&ne<=l;ne+=Q){let ue=h[ne];if(ue==null)continue;let ee=z(g[ne]),U=B(ue);e==1?K(P,ee,D):K(P,H,U),K(P,ee,U),D=U,H=ee}let V=H;s&&e==1&&(V=X+k,K(P,V,D));let[et,we]=Ri(i,o);if(u.fill!=null||et!=0){let ne=q.fill=new Path2D(P),ue=u.fillTo(i,o,u.min,u.max,et),ee=B(ue);K(ne,V,ee),K(ne,Z,ee)}if(!u.spanGaps){let ne=[];ne.push(...Li(g,h,a,l,Q,z,r));let ue=u.width*ae/2,ee=n||e==1?ue:-ue,U=n||e==-1?-ue:ue;ne.forEach(Ce=>{Ce[0]+=ee,Ce[1]+=U}),q.gaps=ne=u.gaps(i,o,a,l,ne),q.clip=$n(ne,p.ori,A,L,E,R)}return we!=0&&(q.band=we==2?[jt(i,o,a,l,P,-1),jt(i,o,a,l,P,1)]:jt(i,o,a,l,P,we)),q})}function _a(t,e,n,r,s,i,o=de){if(t.length>1){let a=null;for(let l=0,u=1/0;l<t.length;l++)if(e[l]!==void 0){if(a!=null){let g=De(t[l]-t[a]);g<u&&(u=g,o=De(n(t[l],r,s,i)-n(t[a],r,s,i)))}a=l}}return o}function ih(t){t=t||hn;let e=ie(t.size,[.6,de,1]),n=t.align||0,r=t.gap||0,s=t.radius;s=s==null?[0,0]:typeof s=="number"?[s,0]:s;let i=re(s),o=1-e[0],a=ie(e[1],de),l=ie(e[2],1),u=ie(t.disp,hn),g=ie(t.each,b=>{}),{fill:h,stroke:p}=u;return(b,_,w,A)=>vr(b,_,(L,E,R,M,X,k,z,B,K,q,P)=>{let Q=L.pxRound,D=n,Y=r*ae,H=a*ae,Z=l*ae,V,et;M.ori==0?[V,et]=i(b,_):[et,V]=i(b,_);let we=M.dir*(M.ori==0?1:-1),ne=M.ori==0?Jn:Pi,ue=M.ori==0?g:(C,ge,Oe,wr,nr,Ft,sr)=>{g(C,ge,Oe,nr,wr,sr,Ft)},ee=ie(b.bands,Ei).find(C=>C.series[0]==_),U=ee!=null?ee.dir:0,Ce=L.fillTo(b,_,L.min,L.max,U),Xe=Q(z(Ce,X,P,K)),xe,le,Et,it=q,Me=Q(L.width*ae),It=!1,Gt=null,mt=null,Yt=null,br=null;h!=null&&(Me==0||p!=null)&&(It=!0,Gt=h.values(b,_,w,A),mt=new Map,new Set(Gt).forEach(C=>{C!=null&&mt.set(C,new Path2D)}),Me>0&&(Yt=p.values(b,_,w,A),br=new Map,new Set(Yt).forEach(C=>{C!=null&&br.set(C,new Path2D)})));let{x0:yr,size:Kr}=u;if(yr!=null&&Kr!=null){D=1,E=yr.values(b,_,w,A),yr.unit==2&&(E=E.map(Oe=>b.posToVal(B+Oe*q,M.key,!0)));let C=Kr.values(b,_,w,A);Kr.unit==2?le=C[0]*q:le=k(C[0],M,q,B)-k(0,M,q,B),it=_a(E,R,k,M,q,B,it),Et=it-le+Y}else it=_a(E,R,k,M,q,B,it),Et=it*o+Y,le=it-Et;Et<1&&(Et=0),Me>=le/2&&(Me=0),Et<5&&(Q=La);let xn=Et>0,tr=it-Et-(xn?Me:0);le=Q(fi(tr,Z,H)),xe=(D==0?le/2:D==we?0:le)-D*we*((D==0?Y/2:0)+(xn?Me/2:0));let $e={stroke:null,fill:null,clip:null,band:null,gaps:null,flags:0},_r=It?null:new Path2D,Vt=null;if(ee!=null)Vt=b.data[ee.series[1]];else{let{y0:C,y1:ge}=u;C!=null&&ge!=null&&(R=ge.values(b,_,w,A),Vt=C.values(b,_,w,A))}let rr=V*le,J=et*le;for(let C=we==1?w:A;C>=w&&C<=A;C+=we){let ge=R[C];if(ge==null)continue;if(Vt!=null){let tt=Vt[C]??0;if(ge-tt==0)continue;Xe=z(tt,X,P,K)}let Oe=M.distr!=2||u!=null?E[C]:C,wr=k(Oe,M,q,B),nr=z(ie(ge,Ce),X,P,K),Ft=Q(wr-xe),sr=Q(Ze(nr,Xe)),ot=Q(Pt(nr,Xe)),pt=sr-ot;if(ge!=null){let tt=ge<0?J:rr,St=ge<0?rr:J;It?(Me>0&&Yt[C]!=null&&ne(br.get(Yt[C]),Ft,ot+ht(Me/2),le,Ze(0,pt-Me),tt,St),Gt[C]!=null&&ne(mt.get(Gt[C]),Ft,ot+ht(Me/2),le,Ze(0,pt-Me),tt,St)):ne(_r,Ft,ot+ht(Me/2),le,Ze(0,pt-Me),tt,St),ue(b,_,C,Ft-Me/2,ot,le+Me,pt)}}return Me>0?$e.stroke=It?br:_r:It||($e._fill=L.width==0?L._fill:L._stroke??L._fill,$e.width=0),$e.fill=It?mt:_r,$e})}function oh(t,e){let n=ie(e?.alignGaps,0);return(r,s,i,o)=>vr(r,s,(a,l,u,g,h,p,b,_,w,A,L)=>{[i,o]=jn(u,i,o);let E=a.pxRound,R=V=>E(p(V,g,A,_)),M=V=>E(b(V,h,L,w)),X,k,z;g.ori==0?(X=Kn,z=Yr,k=rl):(X=Qn,z=qr,k=nl);let B=g.dir*(g.ori==0?1:-1),K=R(l[B==1?i:o]),q=K,P=[],Q=[];for(let V=B==1?i:o;V>=i&&V<=o;V+=B)if(u[V]!=null){let we=l[V],ne=R(we);P.push(q=ne),Q.push(M(u[V]))}let D={stroke:t(P,Q,X,z,k,E),fill:null,clip:null,band:null,gaps:null,flags:Wr},Y=D.stroke,[H,Z]=Ri(r,s);if(a.fill!=null||H!=0){let V=D.fill=new Path2D(Y),et=a.fillTo(r,s,a.min,a.max,H),we=M(et);z(V,q,we),z(V,K,we)}if(!a.spanGaps){let V=[];V.push(...Li(l,u,i,o,B,R,n)),D.gaps=V=a.gaps(r,s,i,o,V),D.clip=$n(V,g.ori,_,w,A,L)}return Z!=0&&(D.band=Z==2?[jt(r,s,i,o,Y,-1),jt(r,s,i,o,Y,1)]:jt(r,s,i,o,Y,Z)),D})}function ah(t){return oh(lh,t)}function lh(t,e,n,r,s,i){let o=t.length;if(o<2)return null;let a=new Path2D;if(n(a,t[0],e[0]),o==2)r(a,t[1],e[1]);else{let l=Array(o),u=Array(o-1),g=Array(o-1),h=Array(o-1);for(let p=0;p<o-1;p++)g[p]=e[p+1]-e[p],h[p]=t[p+1]-t[p],u[p]=g[p]/h[p];l[0]=u[0];for(let p=1;p<o-1;p++)u[p]===0||u[p-1]===0||u[p-1]>0!=u[p]>0?l[p]=0:(l[p]=3*(h[p-1]+h[p])/((2*h[p]+h[p-1])/u[p-1]+(h[p]+2*h[p-1])/u[p]),isFinite(l[p])||(l[p]=0));l[o-1]=u[o-2];for(let p=0;p<o-1;p++)s(a,t[p]+h[p]/3,e[p]+l[p]*h[p]/3,t[p+1]-h[p]/3,e[p+1]-l[p+1]*h[p]/3,t[p+1],e[p+1])}return a}var pi=new Set;function wa(){for(let t of pi)t.syncRect(!0)}jr&&(pr(Vu,Gr,wa),pr(zu,Gr,wa,!0),pr(zn,Gr,()=>{We.pxRatio=ae}));var ch=ol(),uh=sl();function xa(t,e,n,r){return(r?[t[0],t[1]].concat(t.slice(2)):[t[0]].concat(t.slice(1))).map((i,o)=>gi(i,o,e,n))}function fh(t,e){return t.map((n,r)=>r==0?{}:Fe({},e,n))}function gi(t,e,n,r){return Fe({},e==0?n:r,t)}function al(t,e,n){return e==null?zr:[e,n]}var hh=al;function dh(t,e,n){return e==null?zr:Bn(e,n,wi,!0)}function ll(t,e,n,r){return e==null?zr:Yn(e,n,t.scales[r].log,!1)}var mh=ll;function cl(t,e,n,r){return e==null?zr:_i(e,n,t.scales[r].log,!1)}var ph=cl;function gh(t,e,n,r,s){let i=Ze(ea(t),ea(e)),o=e-t,a=Lt(s/r*o,n);do{let l=n[a],u=r*l/o;if(u>=s&&i+(l<5?Zt.get(l):0)<=17)return[l,u]}while(++a<n.length);return[0,0]}function Ea(t){let e,n;return t=t.replace(/(\d+)px/,(r,s)=>(e=Ne((n=+s)*ae))+"px"),[t,e,n]}function vh(t){t.show&&[t.font,t.labelFont].forEach(e=>{let n=me(e[2]*ae,1);e[0]=e[0].replace(/[0-9.]+px/,n+"px"),e[1]=n})}function We(t,e,n){let r={mode:ie(t.mode,1)},s=r.mode;function i(c,f,d,m){let v=f.valToPct(c);return m+d*(f.dir==-1?1-v:v)}function o(c,f,d,m){let v=f.valToPct(c);return m+d*(f.dir==-1?v:1-v)}function a(c,f,d,m){return f.ori==0?i(c,f,d,m):o(c,f,d,m)}r.valToPosH=i,r.valToPosV=o;let l=!1;r.status=0;let u=r.root=wt(Eu);if(t.id!=null&&(u.id=t.id),ft(u,t.class),t.title){let c=wt(Au,u);c.textContent=t.title}let g=Rt("canvas"),h=r.ctx=g.getContext("2d"),p=wt(Tu,u);pr("click",p,c=>{c.target===_&&(ve!=Ir||Ee!=Fr)&&Ye.click(r,c)},!0);let b=r.under=wt(Ru,p);p.appendChild(g);let _=r.over=wt(Lu,p);t=Br(t);let w=+ie(t.pxAlign,1),A=ya(w);(t.plugins||[]).forEach(c=>{c.opts&&(t=c.opts(r,t)||t)});let L=t.ms||.001,E=r.series=s==1?xa(t.series||[],ha,va,!1):fh(t.series||[null],ga),R=r.axes=xa(t.axes||[],fa,ma,!0),M=r.scales={},X=r.bands=t.bands||[];X.forEach(c=>{c.fill=re(c.fill||null),c.dir=ie(c.dir,-1)});let k=s==2?E[1].facets[0].scale:E[0].scale,z={axes:ru,series:Qc},B=(t.drawOrder||["axes","series"]).map(c=>z[c]);function K(c){let f=c.distr==3?d=>Wt(d>0?d:c.clamp(r,d,c.min,c.max,c.key)):c.distr==4?d=>ni(d,c.asinh):c.distr==100?d=>c.fwd(d):d=>d;return d=>{let m=f(d),{_min:v,_max:y}=c,x=y-v;return(m-v)/x}}function q(c){let f=M[c];if(f==null){let d=(t.scales||hn)[c]||hn;if(d.from!=null){q(d.from);let m=Fe({},M[d.from],d,{key:c});m.valToPct=K(m),M[c]=m}else{f=M[c]=Fe({},c==k?Qa:Zf,d),f.key=c;let m=f.time,v=f.range,y=Jt(v);if((c!=k||s==2&&!m)&&(y&&(v[0]==null||v[1]==null)&&(v={min:v[0]==null?Qo:{mode:1,hard:v[0],soft:v[0]},max:v[1]==null?Qo:{mode:1,hard:v[1],soft:v[1]}},y=!1),!y&&Xn(v))){let x=v;v=(S,T,I)=>T==null?zr:Bn(T,I,x)}f.range=re(v||(m?hh:c==k?f.distr==3?mh:f.distr==4?ph:al:f.distr==3?ll:f.distr==4?cl:dh)),f.auto=re(y?!1:f.auto),f.clamp=re(f.clamp||Jf),f._min=f._max=null,f.valToPct=K(f)}}}q("x"),q("y"),s==1&&E.forEach(c=>{q(c.scale)}),R.forEach(c=>{q(c.scale)});for(let c in t.scales)q(c);let P=M[k],Q=P.distr,D,Y;P.ori==0?(ft(u,Su),D=i,Y=o):(ft(u,Mu),D=o,Y=i);let H={};for(let c in M){let f=M[c];(f.min!=null||f.max!=null)&&(H[c]={min:f.min,max:f.max},f.min=f.max=null)}let Z=t.tzDate||(c=>new Date(Ne(c/L))),V=t.fmtDate||Si,et=L==1?Mf(Z):Rf(Z),we=la(Z,aa(L==1?Sf:Tf,V)),ne=ua(Z,ca(Pf,V)),ue=[],ee=r.legend=Fe({},Ff,t.legend),U=r.cursor=Fe({},Uf,{drag:{y:s==2}},t.cursor),Ce=ee.show,Xe=U.show,xe=ee.markers;ee.idxs=ue,xe.width=re(xe.width),xe.dash=re(xe.dash),xe.stroke=re(xe.stroke),xe.fill=re(xe.fill);let le,Et,it,Me=[],It=[],Gt,mt=!1,Yt={};if(ee.live){let c=E[1]?E[1].values:null;mt=c!=null,Gt=mt?c(r,1,0):{_:0};for(let f in Gt)Yt[f]=bi}if(Ce)if(le=Rt("table",Ou,u),it=Rt("tbody",null,le),ee.mount(r,le),mt){Et=Rt("thead",null,le,it);let c=Rt("tr",null,Et);Rt("th",null,c);for(var br in Gt)Rt("th",Ho,c).textContent=br}else ft(le,Du),ee.live&&ft(le,Nu);let yr={show:!0},Kr={show:!1};function xn(c,f){if(f==0&&(mt||!ee.live||s==2))return zr;let d=[],m=Rt("tr",Hu,it,it.childNodes[f]);ft(m,c.class),c.show||ft(m,mr);let v=Rt("th",null,m);if(xe.show){let S=wt(Uu,v);if(f>0){let T=xe.width(r,f);T&&(S.style.border=T+"px "+xe.dash(r,f)+" "+xe.stroke(r,f)),S.style.background=xe.fill(r,f)}}let y=wt(Ho,v);c.label instanceof HTMLElement?y.appendChild(c.label):y.textContent=c.label,f>0&&(xe.show||(y.style.color=c.width>0?xe.stroke(r,f):xe.fill(r,f)),$e("click",v,S=>{if(U._lock)return;or(S);let T=E.indexOf(c);if((S.ctrlKey||S.metaKey)!=ee.isolate){let I=E.some((F,O)=>O>0&&O!=T&&F.show);E.forEach((F,O)=>{O>0&&Ot(O,I?O==T?yr:Kr:yr,!0,ke.setSeries)})}else Ot(T,{show:!c.show},!0,ke.setSeries)},!1),Er&&$e(zo,v,S=>{U._lock||(or(S),Ot(E.indexOf(c),Or,!0,ke.setSeries))},!1));for(var x in Gt){let S=Rt("td",Gu,m);S.textContent="--",d.push(S)}return[m,d]}let tr=new Map;function $e(c,f,d,m=!0){let v=tr.get(f)||{},y=U.bind[c](r,f,d,m);y&&(pr(c,f,v[c]=y),tr.set(f,v))}function _r(c,f,d){let m=tr.get(f)||{};for(let v in m)(c==null||v==c)&&(ui(v,f,m[v]),delete m[v]);c==null&&tr.delete(f)}let Vt=0,rr=0,J=0,C=0,ge=0,Oe=0,wr=ge,nr=Oe,Ft=J,sr=C,ot=0,pt=0,tt=0,St=0;r.bbox={};let Ms=!1,En=!1,xr=!1,ir=!1,Sn=!1,gt=!1;function As(c,f,d){(d||c!=r.width||f!=r.height)&&$i(c,f),Rr(!1),xr=!0,En=!0,Lr()}function $i(c,f){r.width=Vt=J=c,r.height=rr=C=f,ge=Oe=0,Wc(),jc();let d=r.bbox;ot=d.left=hr(ge*ae,.5),pt=d.top=hr(Oe*ae,.5),tt=d.width=hr(J*ae,.5),St=d.height=hr(C*ae,.5)}let Vc=3;function zc(){let c=!1,f=0;for(;!c;){f++;let d=eu(f),m=tu(f);c=f==Vc||d&&m,c||($i(r.width,r.height),En=!0)}}function Bc({width:c,height:f}){As(c,f)}r.setSize=Bc;function Wc(){let c=!1,f=!1,d=!1,m=!1;R.forEach((v,y)=>{if(v.show&&v._show){let{side:x,_size:S}=v,T=x%2,I=v.label!=null?v.labelSize:0,F=S+I;F>0&&(T?(J-=F,x==3?(ge+=F,m=!0):d=!0):(C-=F,x==0?(Oe+=F,c=!0):f=!0))}}),ar[0]=c,ar[1]=d,ar[2]=f,ar[3]=m,J-=qt[1]+qt[3],ge+=qt[3],C-=qt[2]+qt[0],Oe+=qt[0]}function jc(){let c=ge+J,f=Oe+C,d=ge,m=Oe;function v(y,x){switch(y){case 1:return c+=x,c-x;case 2:return f+=x,f-x;case 3:return d-=x,d+x;case 0:return m-=x,m+x}}R.forEach((y,x)=>{if(y.show&&y._show){let S=y.side;y._pos=v(S,y._size),y.label!=null&&(y._lpos=v(S,y.labelSize))}})}if(U.dataIdx==null){let c=U.hover,f=c.skip=new Set(c.skip??[]);f.add(void 0);let d=c.prox=re(c.prox),m=c.bias??=0;U.dataIdx=(v,y,x,S)=>{if(y==0)return x;let T=x,I=d(v,y,x,S)??de,F=I>=0&&I<de,O=P.ori==0?J:C,$=U.left,oe=e[0],se=e[y];if(f.has(se[x])){T=null;let te=null,j=null,G;if(m==0||m==-1)for(G=x;te==null&&G-- >0;)f.has(se[G])||(te=G);if(m==0||m==1)for(G=x;j==null&&G++<se.length;)f.has(se[G])||(j=G);if(te!=null||j!=null)if(F){let ye=te==null?-1/0:D(oe[te],P,O,0),Ae=j==null?1/0:D(oe[j],P,O,0),Be=$-ye,fe=Ae-$;Be<=fe?Be<=I&&(T=te):fe<=I&&(T=j)}else T=j==null?te:te==null?j:x-te<=j-x?te:j}else F&&De($-D(oe[x],P,O,0))>I&&(T=null);return T}}let or=c=>{U.event=c};U.idxs=ue,U._lock=!1;let qe=U.points;qe.show=re(qe.show),qe.size=re(qe.size),qe.stroke=re(qe.stroke),qe.width=re(qe.width),qe.fill=re(qe.fill);let Ct=r.focus=Fe({},t.focus||{alpha:.3},U.focus),Er=Ct.prox>=0,Sr=Er&&qe.one,vt=[],Mr=[],Ar=[];function Ki(c,f){let d=qe.show(r,f);if(d instanceof HTMLElement)return ft(d,Cu),ft(d,c.class),Ut(d,-10,-10,J,C),_.insertBefore(d,vt[f]),d}function Qi(c,f){if(s==1||f>0){let d=s==1&&M[c.scale].time,m=c.value;c.value=d?na(m)?ua(Z,ca(m,V)):m||ne:m||$f,c.label=c.label||(d?Vf:Gf)}if(Sr||f>0){c.width=c.width==null?1:c.width,c.paths=c.paths||ch||Ju,c.fillTo=re(c.fillTo||eh),c.pxAlign=+ie(c.pxAlign,w),c.pxRound=ya(c.pxAlign),c.stroke=re(c.stroke||null),c.fill=re(c.fill||null),c._stroke=c._fill=c._paths=c._focus=null;let d=Kf(Ze(1,c.width),1),m=c.points=Fe({},{size:d,width:Ze(1,d*.2),stroke:c.stroke,space:d*2,paths:uh,_stroke:null,_fill:null},c.points);m.show=re(m.show),m.filter=re(m.filter),m.fill=re(m.fill),m.stroke=re(m.stroke),m.paths=re(m.paths),m.pxAlign=c.pxAlign}if(Ce){let d=xn(c,f);Me.splice(f,0,d[0]),It.splice(f,0,d[1]),ee.values.push(null)}if(Xe){ue.splice(f,0,null);let d=null;Sr?f==0&&(d=Ki(c,f)):f>0&&(d=Ki(c,f)),vt.splice(f,0,d),Mr.splice(f,0,0),Ar.splice(f,0,0)}ze("addSeries",f)}function Yc(c,f){f=f??E.length,c=s==1?gi(c,f,ha,va):gi(c,f,{},ga),E.splice(f,0,c),Qi(E[f],f)}r.addSeries=Yc;function qc(c){if(E.splice(c,1),Ce){ee.values.splice(c,1),It.splice(c,1);let f=Me.splice(c,1)[0];_r(null,f.firstChild),f.remove()}Xe&&(ue.splice(c,1),vt.splice(c,1)[0].remove(),Mr.splice(c,1),Ar.splice(c,1)),ze("delSeries",c)}r.delSeries=qc;let ar=[!1,!1,!1,!1];function Xc(c,f){if(c._show=c.show,c.show){let d=c.side%2,m=M[c.scale];m==null&&(c.scale=d?E[1].scale:k,m=M[c.scale]);let v=m.time;c.size=re(c.size),c.space=re(c.space),c.rotate=re(c.rotate),Jt(c.incrs)&&c.incrs.forEach(x=>{!Zt.has(x)&&Zt.set(x,Ia(x))}),c.incrs=re(c.incrs||(m.distr==2?wf:v?L==1?Ef:Af:dr)),c.splits=re(c.splits||(v&&m.distr==1?et:m.distr==3?hi:m.distr==4?Wf:Bf)),c.stroke=re(c.stroke),c.grid.stroke=re(c.grid.stroke),c.ticks.stroke=re(c.ticks.stroke),c.border.stroke=re(c.border.stroke);let y=c.values;c.values=Jt(y)&&!Jt(y[0])?re(y):v?Jt(y)?la(Z,aa(y,V)):na(y)?Lf(Z,y):y||we:y||zf,c.filter=re(c.filter||(m.distr>=3&&m.log==10?qf:m.distr==3&&m.log==2?Xf:Pa)),c.font=Ea(c.font),c.labelFont=Ea(c.labelFont),c._size=c.size(r,null,f,0),c._space=c._rotate=c._incrs=c._found=c._splits=c._values=null,c._size>0&&(ar[f]=!0,c._el=wt(Pu,p))}}function Qr(c,f,d,m){let[v,y,x,S]=d,T=f%2,I=0;return T==0&&(S||y)&&(I=f==0&&!v||f==2&&!x?Ne(fa.size/3):0),T==1&&(v||x)&&(I=f==1&&!y||f==3&&!S?Ne(ma.size/2):0),I}let Ji=r.padding=(t.padding||[Qr,Qr,Qr,Qr]).map(c=>re(ie(c,Qr))),qt=r._padding=Ji.map((c,f)=>c(r,f,ar,0)),je,He=null,Ue=null,Mn=s==1?E[0].idxs:null,Mt=null,Jr=!1;function Zi(c,f){if(e=c??[],r.data=r._data=e,s==2){je=0;for(let d=1;d<E.length;d++)je+=e[d][0].length}else{e.length==0&&(r.data=r._data=e=[[]]),Mt=e[0],je=Mt.length;let d=e;if(Q==2){d=e.slice();let m=d[0]=Array(je);for(let v=0;v<je;v++)m[v]=v}r._data=e=d}if(Rr(!0),ze("setData"),Q==2&&(xr=!0),f!==!1){let d=P;d.auto(r,Jr)?Ts():$t(k,d.min,d.max),ir=ir||U.left>=0,gt=!0,Lr()}}r.setData=Zi;function Ts(){Jr=!0;let c,f;s==1&&(je>0?(He=Mn[0]=0,Ue=Mn[1]=je-1,c=e[0][He],f=e[0][Ue],Q==2?(c=He,f=Ue):c==f&&(Q==3?[c,f]=Yn(c,c,P.log,!1):Q==4?[c,f]=_i(c,c,P.log,!1):P.time?f=c+Ne(86400/L):[c,f]=Bn(c,f,wi,!0))):(He=Mn[0]=c=null,Ue=Mn[1]=f=null)),$t(k,c,f)}let An,Tr,Rs,Ls,Ps,ks,Is,Fs,Cs,rt;function eo(c,f,d,m,v,y){c??=Go,d??=Ei,m??="butt",v??=Go,y??="round",c!=An&&(h.strokeStyle=An=c),v!=Tr&&(h.fillStyle=Tr=v),f!=Rs&&(h.lineWidth=Rs=f),y!=Ps&&(h.lineJoin=Ps=y),m!=ks&&(h.lineCap=ks=m),d!=Ls&&h.setLineDash(Ls=d)}function to(c,f,d,m){f!=Tr&&(h.fillStyle=Tr=f),c!=Is&&(h.font=Is=c),d!=Fs&&(h.textAlign=Fs=d),m!=Cs&&(h.textBaseline=Cs=m)}function Os(c,f,d,m,v=0){if(m.length>0&&c.auto(r,Jr)&&(f==null||f.min==null)){let y=ie(He,0),x=ie(Ue,m.length-1),S=d.min==null?Yu(m,y,x,v,c.distr==3):[d.min,d.max];c.min=Pt(c.min,d.min=S[0]),c.max=Ze(c.max,d.max=S[1])}}let ro={min:null,max:null};function $c(){for(let m in M){let v=M[m];H[m]==null&&(v.min==null||H[k]!=null&&v.auto(r,Jr))&&(H[m]=ro)}for(let m in M){let v=M[m];H[m]==null&&v.from!=null&&H[v.from]!=null&&(H[m]=ro)}H[k]!=null&&Rr(!0);let c={};for(let m in H){let v=H[m];if(v!=null){let y=c[m]=Br(M[m],tf);if(v.min!=null)Fe(y,v);else if(m!=k||s==2)if(je==0&&y.from==null){let x=y.range(r,null,null,m);y.min=x[0],y.max=x[1]}else y.min=de,y.max=-de}}if(je>0){E.forEach((m,v)=>{if(s==1){let y=m.scale,x=H[y];if(x==null)return;let S=c[y];if(v==0){let T=S.range(r,S.min,S.max,y);S.min=T[0],S.max=T[1],He=Lt(S.min,e[0]),Ue=Lt(S.max,e[0]),Ue-He>1&&(e[0][He]<S.min&&He++,e[0][Ue]>S.max&&Ue--),m.min=Mt[He],m.max=Mt[Ue]}else m.show&&m.auto&&Os(S,x,m,e[v],m.sorted);m.idxs[0]=He,m.idxs[1]=Ue}else if(v>0&&m.show&&m.auto){let[y,x]=m.facets,S=y.scale,T=x.scale,[I,F]=e[v],O=c[S],$=c[T];O!=null&&Os(O,H[S],y,I,y.sorted),$!=null&&Os($,H[T],x,F,x.sorted),m.min=x.min,m.max=x.max}});for(let m in c){let v=c[m],y=H[m];if(v.from==null&&(y==null||y.min==null)){let x=v.range(r,v.min==de?null:v.min,v.max==-de?null:v.max,m);v.min=x[0],v.max=x[1]}}}for(let m in c){let v=c[m];if(v.from!=null){let y=c[v.from];if(y.min==null)v.min=v.max=null;else{let x=v.range(r,y.min,y.max,m);v.min=x[0],v.max=x[1]}}}let f={},d=!1;for(let m in c){let v=c[m],y=M[m];if(y.min!=v.min||y.max!=v.max){y.min=v.min,y.max=v.max;let x=y.distr;y._min=x==3?Wt(y.min):x==4?ni(y.min,y.asinh):x==100?y.fwd(y.min):y.min,y._max=x==3?Wt(y.max):x==4?ni(y.max,y.asinh):x==100?y.fwd(y.max):y.max,f[m]=d=!0}}if(d){E.forEach((m,v)=>{s==2?v>0&&f.y&&(m._paths=null):f[m.scale]&&(m._paths=null)});for(let m in f)xr=!0,ze("setScale",m);Xe&&U.left>=0&&(ir=gt=!0)}for(let m in H)H[m]=null}function Kc(c){let f=fi(He-1,0,je-1),d=fi(Ue+1,0,je-1);for(;c[f]==null&&f>0;)f--;for(;c[d]==null&&d<je-1;)d++;return[f,d]}function Qc(){if(je>0){let c=E.some(f=>f._focus)&&rt!=Ct.alpha;c&&(h.globalAlpha=rt=Ct.alpha),E.forEach((f,d)=>{if(d>0&&f.show&&(no(d,!1),no(d,!0),f._paths==null)){let m=rt;rt!=f.alpha&&(h.globalAlpha=rt=f.alpha);let v=s==2?[0,e[d][0].length-1]:Kc(e[d]);f._paths=f.paths(r,d,v[0],v[1]),rt!=m&&(h.globalAlpha=rt=m)}}),E.forEach((f,d)=>{if(d>0&&f.show){let m=rt;rt!=f.alpha&&(h.globalAlpha=rt=f.alpha),f._paths!=null&&so(d,!1);{let v=f._paths!=null?f._paths.gaps:null,y=f.points.show(r,d,He,Ue,v),x=f.points.filter(r,d,y,v);(y||x)&&(f.points._paths=f.points.paths(r,d,He,Ue,x),so(d,!0))}rt!=m&&(h.globalAlpha=rt=m),ze("drawSeries",d)}}),c&&(h.globalAlpha=rt=1)}}function no(c,f){let d=f?E[c].points:E[c];d._stroke=d.stroke(r,c),d._fill=d.fill(r,c)}function so(c,f){let d=f?E[c].points:E[c],{stroke:m,fill:v,clip:y,flags:x,_stroke:S=d._stroke,_fill:T=d._fill,_width:I=d.width}=d._paths;I=me(I*ae,3);let F=null,O=I%2/2;f&&T==null&&(T=I>0?"#fff":S);let $=d.pxAlign==1&&O>0;if($&&h.translate(O,O),!f){let oe=ot-I/2,se=pt-I/2,te=tt+I,j=St+I;F=new Path2D,F.rect(oe,se,te,j)}f?Ns(S,I,d.dash,d.cap,T,m,v,x,y):Jc(c,S,I,d.dash,d.cap,T,m,v,x,F,y),$&&h.translate(-O,-O)}function Jc(c,f,d,m,v,y,x,S,T,I,F){let O=!1;T!=0&&X.forEach(($,oe)=>{if($.series[0]==c){let se=E[$.series[1]],te=e[$.series[1]],j=(se._paths||hn).band;Jt(j)&&(j=$.dir==1?j[0]:j[1]);let G,ye=null;se.show&&j&&Xu(te,He,Ue)?(ye=$.fill(r,oe)||y,G=se._paths.clip):j=null,Ns(f,d,m,v,ye,x,S,T,I,F,G,j),O=!0}}),O||Ns(f,d,m,v,y,x,S,T,I,F)}let io=Wr|mi;function Ns(c,f,d,m,v,y,x,S,T,I,F,O){eo(c,f,d,m,v),(T||I||O)&&(h.save(),T&&h.clip(T),I&&h.clip(I)),O?(S&io)==io?(h.clip(O),F&&h.clip(F),Rn(v,x),Tn(c,y,f)):S&mi?(Rn(v,x),h.clip(O),Tn(c,y,f)):S&Wr&&(h.save(),h.clip(O),F&&h.clip(F),Rn(v,x),h.restore(),Tn(c,y,f)):(Rn(v,x),Tn(c,y,f)),(T||I||O)&&h.restore()}function Tn(c,f,d){d>0&&(f instanceof Map?f.forEach((m,v)=>{h.strokeStyle=An=v,h.stroke(m)}):f!=null&&c&&h.stroke(f))}function Rn(c,f){f instanceof Map?f.forEach((d,m)=>{h.fillStyle=Tr=m,h.fill(d)}):f!=null&&c&&h.fill(f)}function Zc(c,f,d,m){let v=R[c],y;if(m<=0)y=[0,0];else{let x=v._space=v.space(r,c,f,d,m),S=v._incrs=v.incrs(r,c,f,d,m,x);y=gh(f,d,S,m,x)}return v._found=y}function Ds(c,f,d,m,v,y,x,S,T,I){let F=x%2/2;w==1&&h.translate(F,F),eo(S,x,T,I,S),h.beginPath();let O,$,oe,se,te=v+(m==0||m==3?-y:y);d==0?($=v,se=te):(O=v,oe=te);for(let j=0;j<c.length;j++)f[j]!=null&&(d==0?O=oe=c[j]:$=se=c[j],h.moveTo(O,$),h.lineTo(oe,se));h.stroke(),w==1&&h.translate(-F,-F)}function eu(c){let f=!0;return R.forEach((d,m)=>{if(!d.show)return;let v=M[d.scale];if(v.min==null){d._show&&(f=!1,d._show=!1,Rr(!1));return}else d._show||(f=!1,d._show=!0,Rr(!1));let y=d.side,x=y%2,{min:S,max:T}=v,[I,F]=Zc(m,S,T,x==0?J:C);if(F==0)return;let O=v.distr==2,$=d._splits=d.splits(r,m,S,T,I,F,O),oe=v.distr==2?$.map(G=>Mt[G]):$,se=v.distr==2?Mt[$[1]]-Mt[$[0]]:I,te=d._values=d.values(r,d.filter(r,oe,m,F,se),m,F,se);d._rotate=y==2?d.rotate(r,te,m,F):0;let j=d._size;d._size=xt(d.size(r,te,m,c)),j!=null&&d._size!=j&&(f=!1)}),f}function tu(c){let f=!0;return Ji.forEach((d,m)=>{let v=d(r,m,ar,c);v!=qt[m]&&(f=!1),qt[m]=v}),f}function ru(){for(let c=0;c<R.length;c++){let f=R[c];if(!f.show||!f._show)continue;let d=f.side,m=d%2,v,y,x=f.stroke(r,c),S=d==0||d==3?-1:1,[T,I]=f._found;if(f.label!=null){let Qe=f.labelGap*S,ct=Ne((f._lpos+Qe)*ae);to(f.labelFont[0],x,"center",d==2?"top":Uo),h.save(),m==1?(v=y=0,h.translate(ct,Ne(pt+St/2)),h.rotate((d==3?-Vn:Vn)/2)):(v=Ne(ot+tt/2),y=ct);let ur=Ra(f.label)?f.label(r,c,T,I):f.label;h.fillText(ur,v,y),h.restore()}if(I==0)continue;let F=M[f.scale],O=m==0?tt:St,$=m==0?ot:pt,oe=f._splits,se=F.distr==2?oe.map(Qe=>Mt[Qe]):oe,te=F.distr==2?Mt[oe[1]]-Mt[oe[0]]:T,j=f.ticks,G=f.border,ye=j.show?j.size:0,Ae=Ne(ye*ae),Be=Ne((f.alignTo==2?f._size-ye-f.gap:f.gap)*ae),fe=f._rotate*-Vn/180,Te=A(f._pos*ae),at=(Ae+Be)*S,Ke=Te+at;y=m==0?Ke:0,v=m==1?Ke:0;let bt=f.font[0],At=f.align==1?Hr:f.align==2?ei:fe>0?Hr:fe<0?ei:m==0?"center":d==3?ei:Hr,Dt=fe||m==1?"middle":d==2?"top":Uo;to(bt,x,At,Dt);let lt=f.font[1]*f.lineGap,yt=oe.map(Qe=>A(a(Qe,F,O,$))),Tt=f._values;for(let Qe=0;Qe<Tt.length;Qe++){let ct=Tt[Qe];if(ct!=null){m==0?v=yt[Qe]:y=yt[Qe],ct=""+ct;let ur=ct.indexOf(`
`)==-1?[ct]:ct.split(/\n/gm);for(let Je=0;Je<ur.length;Je++){let Mo=ur[Je];fe?(h.save(),h.translate(v,y+Je*lt),h.rotate(fe),h.fillText(Mo,0,0),h.restore()):h.fillText(Mo,v,y+Je*lt)}}}j.show&&Ds(yt,j.filter(r,se,c,I,te),m,d,Te,Ae,me(j.width*ae,3),j.stroke(r,c),j.dash,j.cap);let Ht=f.grid;Ht.show&&Ds(yt,Ht.filter(r,se,c,I,te),m,m==0?2:1,m==0?pt:ot,m==0?St:tt,me(Ht.width*ae,3),Ht.stroke(r,c),Ht.dash,Ht.cap),G.show&&Ds([Te],[1],m==0?1:0,m==0?1:2,m==1?pt:ot,m==1?St:tt,me(G.width*ae,3),G.stroke(r,c),G.dash,G.cap)}ze("drawAxes")}function Rr(c){E.forEach((f,d)=>{d>0&&(f._paths=null,c&&(s==1?(f.min=null,f.max=null):f.facets.forEach(m=>{m.min=null,m.max=null})))})}let Ln=!1,Hs=!1,Zr=[];function nu(){Hs=!1;for(let c=0;c<Zr.length;c++)ze(...Zr[c]);Zr.length=0}function Lr(){Ln||(cf(oo),Ln=!0)}function su(c,f=!1){Ln=!0,Hs=f,c(r),oo(),f&&Zr.length>0&&queueMicrotask(nu)}r.batch=su;function oo(){if(Ms&&($c(),Ms=!1),xr&&(zc(),xr=!1),En){if(_e(b,Hr,ge),_e(b,"top",Oe),_e(b,ln,J),_e(b,cn,C),_e(_,Hr,ge),_e(_,"top",Oe),_e(_,ln,J),_e(_,cn,C),_e(p,ln,Vt),_e(p,cn,rr),g.width=Ne(Vt*ae),g.height=Ne(rr*ae),R.forEach(({_el:c,_show:f,_size:d,_pos:m,side:v})=>{if(c!=null)if(f){let y=v===3||v===0?d:0,x=v%2==1;_e(c,x?"left":"top",m-y),_e(c,x?"width":"height",d),_e(c,x?"top":"left",x?Oe:ge),_e(c,x?"height":"width",x?C:J),ci(c,mr)}else ft(c,mr)}),An=Tr=Rs=Ps=ks=Is=Fs=Cs=Ls=null,rt=1,rn(!0),ge!=wr||Oe!=nr||J!=Ft||C!=sr){Rr(!1);let c=J/Ft,f=C/sr;if(Xe&&!ir&&U.left>=0){U.left*=c,U.top*=f,Pr&&Ut(Pr,Ne(U.left),0,J,C),kr&&Ut(kr,0,Ne(U.top),J,C);for(let d=0;d<vt.length;d++){let m=vt[d];m!=null&&(Mr[d]*=c,Ar[d]*=f,Ut(m,xt(Mr[d]),xt(Ar[d]),J,C))}}if(be.show&&!Sn&&be.left>=0&&be.width>0){be.left*=c,be.width*=c,be.top*=f,be.height*=f;for(let d in Ws)_e(Cr,d,be[d])}wr=ge,nr=Oe,Ft=J,sr=C}ze("setSize"),En=!1}Vt>0&&rr>0&&(h.clearRect(0,0,g.width,g.height),ze("drawClear"),B.forEach(c=>c()),ze("draw")),be.show&&Sn&&(Pn(be),Sn=!1),Xe&&ir&&(cr(null,!0,!1),ir=!1),ee.show&&ee.live&&gt&&(zs(),gt=!1),l||(l=!0,r.status=1,ze("ready")),Jr=!1,Ln=!1}r.redraw=(c,f)=>{xr=f||!1,c!==!1?$t(k,P.min,P.max):Lr()};function Us(c,f){let d=M[c];if(d.from==null){if(je==0){let m=d.range(r,f.min,f.max,c);f.min=m[0],f.max=m[1]}if(f.min>f.max){let m=f.min;f.min=f.max,f.max=m}if(je>1&&f.min!=null&&f.max!=null&&f.max-f.min<1e-16)return;c==k&&d.distr==2&&je>0&&(f.min=Lt(f.min,e[0]),f.max=Lt(f.max,e[0]),f.min==f.max&&f.max++),H[c]=f,Ms=!0,Lr()}}r.setScale=Us;let Gs,Vs,Pr,kr,ao,lo,Ir,Fr,co,uo,ve,Ee,Xt=!1,Ye=U.drag,Ge=Ye.x,Ve=Ye.y;Xe&&(U.x&&(Gs=wt(Iu,_)),U.y&&(Vs=wt(Fu,_)),P.ori==0?(Pr=Gs,kr=Vs):(Pr=Vs,kr=Gs),ve=U.left,Ee=U.top);let be=r.select=Fe({show:!0,over:!0,left:0,width:0,top:0,height:0},t.select),Cr=be.show?wt(ku,be.over?_:b):null;function Pn(c,f){if(be.show){for(let d in c)be[d]=c[d],d in Ws&&_e(Cr,d,c[d]);f!==!1&&ze("setSelect")}}r.setSelect=Pn;function iu(c){if(E[c].show)Ce&&ci(Me[c],mr);else if(Ce&&ft(Me[c],mr),Xe){let d=Sr?vt[0]:vt[c];d!=null&&Ut(d,-10,-10,J,C)}}function $t(c,f,d){Us(c,{min:f,max:d})}function Ot(c,f,d,m){f.focus!=null&&uu(c),f.show!=null&&E.forEach((v,y)=>{y>0&&(c==y||c==null)&&(v.show=f.show,iu(y),s==2?($t(v.facets[0].scale,null,null),$t(v.facets[1].scale,null,null)):$t(v.scale,null,null),Lr())}),d!==!1&&ze("setSeries",c,f),m&&nn("setSeries",r,c,f)}r.setSeries=Ot;function ou(c,f){Fe(X[c],f)}function au(c,f){c.fill=re(c.fill||null),c.dir=ie(c.dir,-1),f=f??X.length,X.splice(f,0,c)}function lu(c){c==null?X.length=0:X.splice(c,1)}r.addBand=au,r.setBand=ou,r.delBand=lu;function cu(c,f){E[c].alpha=f,Xe&&vt[c]!=null&&(vt[c].style.opacity=f),Ce&&Me[c]&&(Me[c].style.opacity=f)}let zt,Kt,lr,Or={focus:!0};function uu(c){if(c!=lr){let f=c==null,d=Ct.alpha!=1;E.forEach((m,v)=>{if(s==1||v>0){let y=f||v==0||v==c;m._focus=f?null:y,d&&cu(v,y?1:Ct.alpha)}}),lr=c,d&&Lr()}}Ce&&Er&&$e(Bo,le,c=>{U._lock||(or(c),lr!=null&&Ot(null,Or,!0,ke.setSeries))});function Nt(c,f,d){let m=M[f];d&&(c=c/ae-(m.ori==1?Oe:ge));let v=J;m.ori==1&&(v=C,c=v-c),m.dir==-1&&(c=v-c);let y=m._min,x=m._max,S=c/v,T=y+(x-y)*S,I=m.distr;return I==3?Vr(10,T):I==4?Ku(T,m.asinh):I==100?m.bwd(T):T}function fu(c,f){let d=Nt(c,k,f);return Lt(d,e[0],He,Ue)}r.valToIdx=c=>Lt(c,e[0]),r.posToIdx=fu,r.posToVal=Nt,r.valToPos=(c,f,d)=>M[f].ori==0?i(c,M[f],d?tt:J,d?ot:0):o(c,M[f],d?St:C,d?pt:0),r.setCursor=(c,f,d)=>{ve=c.left,Ee=c.top,cr(null,f,d)};function fo(c,f){_e(Cr,Hr,be.left=c),_e(Cr,ln,be.width=f)}function ho(c,f){_e(Cr,"top",be.top=c),_e(Cr,cn,be.height=f)}let en=P.ori==0?fo:ho,tn=P.ori==1?fo:ho;function hu(){if(Ce&&ee.live)for(let c=s==2?1:0;c<E.length;c++){if(c==0&&mt)continue;let f=ee.values[c],d=0;for(let m in f)It[c][d++].firstChild.nodeValue=f[m]}}function zs(c,f){if(c!=null&&(c.idxs?c.idxs.forEach((d,m)=>{ue[m]=d}):ef(c.idx)||ue.fill(c.idx),ee.idx=ue[0]),Ce&&ee.live){for(let d=0;d<E.length;d++)(d>0||s==1&&!mt)&&du(d,ue[d]);hu()}gt=!1,f!==!1&&ze("setLegend")}r.setLegend=zs;function du(c,f){let d=E[c],m=c==0&&Q==2?Mt:e[c],v;mt?v=d.values(r,c,f)??Yt:(v=d.value(r,f==null?null:m[f],c,f),v=v==null?Yt:{_:v}),ee.values[c]=v}function cr(c,f,d){co=ve,uo=Ee,[ve,Ee]=U.move(r,ve,Ee),U.left=ve,U.top=Ee,Xe&&(Pr&&Ut(Pr,Ne(ve),0,J,C),kr&&Ut(kr,0,Ne(Ee),J,C));let m,v=He>Ue;zt=de,Kt=null;let y=P.ori==0?J:C,x=P.ori==1?J:C;if(ve<0||je==0||v){m=U.idx=null;for(let S=0;S<E.length;S++){let T=vt[S];T!=null&&Ut(T,-10,-10,J,C)}Er&&Ot(null,Or,!0,c==null&&ke.setSeries),ee.live&&(ue.fill(m),gt=!0)}else{let S,T,I;s==1&&(S=P.ori==0?ve:Ee,T=Nt(S,k),m=U.idx=Lt(T,e[0],He,Ue),I=D(e[0][m],P,y,0));let F=-10,O=-10,$=0,oe=0,se=!0,te="",j="";for(let G=s==2?1:0;G<E.length;G++){let ye=E[G],Ae=ue[G],Be=Ae==null?null:s==1?e[G][Ae]:e[G][1][Ae],fe=U.dataIdx(r,G,m,T),Te=fe==null?null:s==1?e[G][fe]:e[G][1][fe];if(gt=gt||Te!=Be||fe!=Ae,ue[G]=fe,G>0&&ye.show){let at=fe==null?-10:fe==m?I:D(s==1?e[0][fe]:e[G][0][fe],P,y,0),Ke=Te==null?-10:Y(Te,s==1?M[ye.scale]:M[ye.facets[1].scale],x,0);if(Er&&Te!=null){let bt=P.ori==1?ve:Ee,At=De(Ct.dist(r,G,fe,Ke,bt));if(At<zt){let Dt=Ct.bias;if(Dt!=0){let lt=Nt(bt,ye.scale),yt=Te>=0?1:-1,Tt=lt>=0?1:-1;Tt==yt&&(Tt==1?Dt==1?Te>=lt:Te<=lt:Dt==1?Te<=lt:Te>=lt)&&(zt=At,Kt=G)}else zt=At,Kt=G}}if(gt||Sr){let bt,At;P.ori==0?(bt=at,At=Ke):(bt=Ke,At=at);let Dt,lt,yt,Tt,Ht,Qe,ct=!0,ur=qe.bbox;if(ur!=null){ct=!1;let Je=ur(r,G);yt=Je.left,Tt=Je.top,Dt=Je.width,lt=Je.height}else yt=bt,Tt=At,Dt=lt=qe.size(r,G);if(Qe=qe.fill(r,G),Ht=qe.stroke(r,G),Sr)G==Kt&&zt<=Ct.prox&&(F=yt,O=Tt,$=Dt,oe=lt,se=ct,te=Qe,j=Ht);else{let Je=vt[G];Je!=null&&(Mr[G]=yt,Ar[G]=Tt,Ko(Je,Dt,lt,ct),Xo(Je,Qe,Ht),Ut(Je,xt(yt),xt(Tt),J,C))}}}}if(Sr){let G=Ct.prox,ye=lr==null?zt<=G:zt>G||Kt!=lr;if(gt||ye){let Ae=vt[0];Ae!=null&&(Mr[0]=F,Ar[0]=O,Ko(Ae,$,oe,se),Xo(Ae,te,j),Ut(Ae,xt(F),xt(O),J,C))}}}if(be.show&&Xt)if(c!=null){let[S,T]=ke.scales,[I,F]=ke.match,[O,$]=c.cursor.sync.scales,oe=c.cursor.drag;if(Ge=oe._x,Ve=oe._y,Ge||Ve){let{left:se,top:te,width:j,height:G}=c.select,ye=c.scales[O].ori,Ae=c.posToVal,Be,fe,Te,at,Ke,bt=S!=null&&I(S,O),At=T!=null&&F(T,$);bt&&Ge?(ye==0?(Be=se,fe=j):(Be=te,fe=G),Te=M[S],at=D(Ae(Be,O),Te,y,0),Ke=D(Ae(Be+fe,O),Te,y,0),en(Pt(at,Ke),De(Ke-at))):en(0,y),At&&Ve?(ye==1?(Be=se,fe=j):(Be=te,fe=G),Te=M[T],at=Y(Ae(Be,$),Te,x,0),Ke=Y(Ae(Be+fe,$),Te,x,0),tn(Pt(at,Ke),De(Ke-at))):tn(0,x)}else js()}else{let S=De(co-ao),T=De(uo-lo);if(P.ori==1){let $=S;S=T,T=$}Ge=Ye.x&&S>=Ye.dist,Ve=Ye.y&&T>=Ye.dist;let I=Ye.uni;I!=null?Ge&&Ve&&(Ge=S>=I,Ve=T>=I,!Ge&&!Ve&&(T>S?Ve=!0:Ge=!0)):Ye.x&&Ye.y&&(Ge||Ve)&&(Ge=Ve=!0);let F,O;Ge&&(P.ori==0?(F=Ir,O=ve):(F=Fr,O=Ee),en(Pt(F,O),De(O-F)),Ve||tn(0,x)),Ve&&(P.ori==1?(F=Ir,O=ve):(F=Fr,O=Ee),tn(Pt(F,O),De(O-F)),Ge||en(0,y)),!Ge&&!Ve&&(en(0,0),tn(0,0))}if(Ye._x=Ge,Ye._y=Ve,c==null){if(d){if(So!=null){let[S,T]=ke.scales;ke.values[0]=S!=null?Nt(P.ori==0?ve:Ee,S):null,ke.values[1]=T!=null?Nt(P.ori==1?ve:Ee,T):null}nn(ti,r,ve,Ee,J,C,m)}if(Er){let S=d&&ke.setSeries,T=Ct.prox;lr==null?zt<=T&&Ot(Kt,Or,!0,S):zt>T?Ot(null,Or,!0,S):Kt!=lr&&Ot(Kt,Or,!0,S)}}gt&&(ee.idx=m,zs()),f!==!1&&ze("setCursor")}let Qt=null;Object.defineProperty(r,"rect",{get(){return Qt==null&&rn(!1),Qt}});function rn(c=!1){c?Qt=null:(Qt=_.getBoundingClientRect(),ze("syncRect",Qt))}function mo(c,f,d,m,v,y,x){U._lock||Xt&&c!=null&&c.movementX==0&&c.movementY==0||(Bs(c,f,d,m,v,y,x,!1,c!=null),c!=null?cr(null,!0,!0):cr(f,!0,!1))}function Bs(c,f,d,m,v,y,x,S,T){if(Qt==null&&rn(!1),or(c),c!=null)d=c.clientX-Qt.left,m=c.clientY-Qt.top;else{if(d<0||m<0){ve=-10,Ee=-10;return}let[I,F]=ke.scales,O=f.cursor.sync,[$,oe]=O.values,[se,te]=O.scales,[j,G]=ke.match,ye=f.axes[0].side%2==1,Ae=P.ori==0?J:C,Be=P.ori==1?J:C,fe=ye?y:v,Te=ye?v:y,at=ye?m:d,Ke=ye?d:m;if(se!=null?d=j(I,se)?a($,M[I],Ae,0):-10:d=Ae*(at/fe),te!=null?m=G(F,te)?a(oe,M[F],Be,0):-10:m=Be*(Ke/Te),P.ori==1){let bt=d;d=m,m=bt}}T&&(f==null||f.cursor.event.type==ti)&&((d<=1||d>=J-1)&&(d=hr(d,J)),(m<=1||m>=C-1)&&(m=hr(m,C))),S?(ao=d,lo=m,[Ir,Fr]=U.move(r,d,m)):(ve=d,Ee=m)}let Ws={width:0,height:0,left:0,top:0};function js(){Pn(Ws,!1)}let po,go,vo,bo;function yo(c,f,d,m,v,y,x){Xt=!0,Ge=Ve=Ye._x=Ye._y=!1,Bs(c,f,d,m,v,y,x,!0,!1),c!=null&&($e(ri,ai,_o,!1),nn(Vo,r,Ir,Fr,J,C,null));let{left:S,top:T,width:I,height:F}=be;po=S,go=T,vo=I,bo=F}function _o(c,f,d,m,v,y,x){Xt=Ye._x=Ye._y=!1,Bs(c,f,d,m,v,y,x,!1,!0);let{left:S,top:T,width:I,height:F}=be,O=I>0||F>0,$=po!=S||go!=T||vo!=I||bo!=F;if(O&&$&&Pn(be),Ye.setScale&&O&&$){let oe=S,se=I,te=T,j=F;if(P.ori==1&&(oe=T,se=F,te=S,j=I),Ge&&$t(k,Nt(oe,k),Nt(oe+se,k)),Ve)for(let G in M){let ye=M[G];G!=k&&ye.from==null&&ye.min!=de&&$t(G,Nt(te+j,G),Nt(te,G))}js()}else U.lock&&(U._lock=!U._lock,cr(f,!0,c!=null));c!=null&&(_r(ri,ai),nn(ri,r,ve,Ee,J,C,null))}function mu(c,f,d,m,v,y,x){if(U._lock)return;or(c);let S=Xt;if(Xt){let T=!0,I=!0,F=10,O,$;P.ori==0?(O=Ge,$=Ve):(O=Ve,$=Ge),O&&$&&(T=ve<=F||ve>=J-F,I=Ee<=F||Ee>=C-F),O&&T&&(ve=ve<Ir?0:J),$&&I&&(Ee=Ee<Fr?0:C),cr(null,!0,!0),Xt=!1}ve=-10,Ee=-10,ue.fill(null),cr(null,!0,!0),S&&(Xt=S)}function wo(c,f,d,m,v,y,x){U._lock||(or(c),Ts(),js(),c!=null&&nn(Wo,r,ve,Ee,J,C,null))}function xo(){R.forEach(vh),As(r.width,r.height,!0)}pr(zn,Gr,xo);let Nr={};Nr.mousedown=yo,Nr.mousemove=mo,Nr.mouseup=_o,Nr.dblclick=wo,Nr.setSeries=(c,f,d,m)=>{let v=ke.match[2];d=v(r,f,d),d!=-1&&Ot(d,m,!0,!1)},Xe&&($e(Vo,_,yo),$e(ti,_,mo),$e(zo,_,c=>{or(c),rn(!1)}),$e(Bo,_,mu),$e(Wo,_,wo),pi.add(r),r.syncRect=rn);let kn=r.hooks=t.hooks||{};function ze(c,f,d){Hs?Zr.push([c,f,d]):c in kn&&kn[c].forEach(m=>{m.call(null,r,f,d)})}(t.plugins||[]).forEach(c=>{for(let f in c.hooks)kn[f]=(kn[f]||[]).concat(c.hooks[f])});let Eo=(c,f,d)=>d,ke=Fe({key:null,setSeries:!1,filters:{pub:ta,sub:ta},scales:[k,E[1]?E[1].scale:null],match:[ra,ra,Eo],values:[null,null]},U.sync);ke.match.length==2&&ke.match.push(Eo),U.sync=ke;let So=ke.key,Ys=Ja(So);function nn(c,f,d,m,v,y,x){ke.filters.pub(c,f,d,m,v,y,x)&&Ys.pub(c,f,d,m,v,y,x)}Ys.sub(r);function pu(c,f,d,m,v,y,x){ke.filters.sub(c,f,d,m,v,y,x)&&Nr[c](null,f,d,m,v,y,x)}r.pub=pu;function gu(){Ys.unsub(r),pi.delete(r),tr.clear(),ui(zn,Gr,xo),u.remove(),le?.remove(),ze("destroy")}r.destroy=gu;function qs(){ze("init",t,e),Zi(e||t.data,!1),H[k]?Us(k,H[k]):Ts(),Sn=be.show&&(be.width>0||be.height>0),ir=gt=!0,As(t.width,t.height)}return E.forEach(Qi),R.forEach(Xc),n?n instanceof HTMLElement?(n.appendChild(u),qs()):n(r,qs):qs(),r}We.assign=Fe;We.fmtNum=xi;We.rangeNum=Bn;We.rangeLog=Yn;We.rangeAsinh=_i;We.orient=vr;We.pxRatio=ae;We.join=lf;We.fmtDate=Si,We.tzDate=yf;We.sync=Ja;{We.addGap=th,We.clipGaps=$n;let t=We.paths={points:sl};t.linear=ol,t.stepped=sh,t.bars=ih,t.spline=ah}var ul=96,bh=8,Zn=["#2f8fef","#e8820c","#1fa367","#a45ee5","#e5484d","#12a5b8","#b58900","#d6409f","#6e7fd9","#7a8b3a"];function ki(t,e){let[n,r]=[0,t.times.length];for(;n<r;){let s=n+r>>1;t.times[s]<=e+1e-4?n=s+1:r=s}return n===0?null:t.values[n-1]}var er=class{constructor(e,n){this.container=e;this.seek=n;this.set([]),new ResizeObserver(()=>this.resize()).observe(e)}container;seek;charts=[];time=0;set(e){for(let{plot:n}of this.charts)n.destroy();this.container.replaceChildren(),this.charts=e.map((n,r)=>this.chart(n,r))}redraw(){for(let{plot:e}of this.charts)e.redraw(!1)}show(e,n){this.time=e,n.length===this.charts.length&&n.every((s,i)=>s===this.charts[i].curve)||this.set(n);for(let s of this.charts){let i=ki(s.curve,e);s.value.textContent=xh(s.curve,i);let o=s.curve.times.at(-1);s.drawnTime!==o&&(s.drawnTime=o,s.plot.setData([s.curve.times,s.curve.values])),this.moveCursor(s)}}moveCursor({plot:e,cursor:n}){let r=e.valToPos(this.time,"x");n.hidden=!(r>=0&&r<=e.over.clientWidth),n.style.transform=`translateX(${r}px)`}chart(e,n){let r=document.createElement("figure"),s=document.createElement("figcaption"),i=document.createElement("button"),o=document.createElement("output");i.textContent=e.name.replaceAll("_"," "),i.title=`${e.name}: fold or unfold`;let a=g=>{r.classList.toggle("folded",g),i.setAttribute("aria-expanded",String(!g))};i.addEventListener("click",()=>a(!r.classList.contains("folded"))),a(n>=bh),i.style.setProperty("--mark",Zn[n%Zn.length]),s.append(i,o),r.append(s),this.container.append(r);let l=new We(this.options(e,Zn[n%Zn.length]),[e.times,e.values],r);l.over.addEventListener("click",g=>this.seek(l.posToVal(g.offsetX,"x")));let u=document.createElement("i");return u.className="cursor",l.over.append(u),{curve:e,plot:l,cursor:u,value:o,drawnTime:e.times.at(-1)}}options({names:e,isFraction:n},r){let s=o=>getComputedStyle(this.container).getPropertyValue(o).trim(),i=()=>({stroke:()=>s("--soft"),grid:{stroke:()=>s("--line"),width:1},ticks:{show:!1},font:"10px system-ui, sans-serif"});return{width:Math.max(120,this.container.clientWidth-20),height:ul,legend:{show:!1},cursor:{y:!1,drag:{x:!1,y:!1},points:{show:!1}},scales:{x:{time:!1},y:{range:yh(e,n)}},axes:[{...i(),size:20,gap:2},{...i(),size:44,gap:2,space:12,values:(o,a,l,u,g)=>a.map(h=>_h(h,g)),...e?.length?{incrs:[1,2,5,10]}:{}}],series:[{},{stroke:r,width:1.5,spanGaps:!1,paths:e?.length?We.paths.stepped({align:1}):void 0,points:{show:!0,size:4,fill:r,filter:wh}}]}}resize(){let e=Math.max(120,this.container.clientWidth-20);for(let n of this.charts)n.plot.setSize({width:e,height:ul}),this.moveCursor(n)}};function yh(t,e){return t?.length?[0,t.length]:e?[0,1]:(n,r,s)=>{if(r===null||s===null)return[0,1];let i=s-r<1e-5*Math.max(Math.abs(r),Math.abs(s),1e-6);if(i&&r>=0)return[0,s>0?2*s:1];let o=i?Math.max(.5,.1*Math.abs(s)):.08*(s-r);return[r-o,s+o]}}function _h(t,e){let n=[0,1,2,3,4,5].find(r=>Math.abs(e*10**r-Math.round(e*10**r))<1e-6)??9;return Math.abs(t)>=1e5||n>5?t===0?"0":t.toExponential(1):String(Number(t.toFixed(n)))}function wh(t,e){let n=t.data[e],r=s=>n[s]===null||n[s]===void 0;return[...n.keys()].filter(s=>!r(s)&&r(s-1)&&r(s+1))}function xh({unit:t,names:e},n){return n===null?"–":e?.length?e[n-1]??"none yet":`${Eh(n)} ${t==="1"?"":t}`.trim()}function Eh(t){let e=Math.abs(t);return t===0?"0":e>=1e5||e<.001?t.toExponential(2):t.toPrecision(4)}var Ii=3e3,Sh=16,es=class{constructor(e){this.request=e;let n=N("topic");n.addEventListener("change",()=>{this.add(n.value),n.value=""})}request;cards=new Map;types={};list(e){this.types=Object.fromEntries(e);let n=N("topic"),r=e.map(([s,i])=>new Option(`${s}  (${i.replace("/msg/","/")})`,s));n.replaceChildren(new Option("Show a topic…",""),...r),N("topics-box").hidden=!e.length}showMessage(e){this.cards.get(e.name)?.showMessage(e)}show(e){for(let n of this.cards.values())n.show(e)}redrawCurves(){for(let e of this.cards.values())e.curves.redraw()}add(e){if(!e||this.cards.has(e)||this.cards.size>=Sh)return;let n=new Fi(e,this.types[e]??"",()=>{this.cards.delete(e),this.request([...this.cards.keys()])});this.cards.set(e,n),N("topics").append(n.box),this.request([...this.cards.keys()])}},Fi=class{box=W("div","","topic");curves;rows=new Map;samples=new Map;selection=new Set;table=W("div","","fields");note=W("p","No message yet. A topic without a subscriber may have none.","none");constructor(e,n,r){let[s,i,o]=[W("h3"),W("button","×"),W("div")];i.title=`Hide ${e}`,i.setAttribute("aria-label",i.title),i.addEventListener("click",()=>{this.box.remove(),r()});let a=W("span",e);a.title=n,s.append(a,i),this.box.append(s,this.note,this.table,o),this.curves=new er(o,()=>{})}showMessage({time:e,fields:n,is_cut:r}){this.note.textContent=r?"The first fields of the message:":"",this.note.hidden=!r;for(let[s,i]of n){let o=this.samples.size===0;typeof i=="number"&&this.store(s,e,i),o&&this.samples.size&&this.selection.add(s);let a=this.rows.get(s)??this.row(s,typeof i=="number");a.value.textContent=typeof i=="number"?String(Number(i.toPrecision(6))):i??"–"}this.mark()}show(e){let n=[...this.samples].filter(([r])=>this.selection.has(r));this.curves.show(e,n.map(([,r])=>r))}store(e,n,r){let s=this.samples.get(e);s||this.samples.set(e,s={name:e,unit:"",times:[],values:[]}),!(n<=(s.times.at(-1)??-1))&&(s.times.push(n),s.values.push(r),!(s.times.length<=Ii)&&(s.times.splice(0,Ii/2),s.values.splice(0,Ii/2)))}row(e,n){let[r,s]=[W(n?"button":"div","","field"),W("output")];r.append(W("span",e),s),n&&(r.title="Show or hide its curve",r.addEventListener("click",()=>{this.selection.delete(e)||this.selection.add(e),this.mark()})),this.table.append(r);let i={row:r,value:s};return this.rows.set(e,i),i}mark(){for(let[e,{row:n}]of this.rows)n instanceof HTMLButtonElement&&n.setAttribute("aria-pressed",String(this.selection.has(e)))}};var Xr=16,Mh=100,Ah=640,Ci=class{constructor(e,n,r,s){this.socket=e;this.pack=n;this.earlyEvents=r;this.isServerDrawn=s;e.onclose=()=>this.end("The simulation has ended.")}socket;pack;earlyEvents;isServerDrawn;pilot=new Dn((e,n)=>{this.send(e),n&&this.page?.picture.skipPauses()});topics=new es(e=>this.send({type:"topics",names:e}));page=null;stream=null;lastRequest="";imageNumbers=[];allowsReset=!1;begin(e,n){this.page=e,this.stream=n;for(let r of this.earlyEvents)this.receive(r);this.socket.onmessage=r=>this.receive(r),this.subscribe(e.switches.pictures)}subscribe(e){let n=e?this.pack.head.cameras.map(({name:r})=>r):[];this.send({type:"images",cameras:n,rate:10,width:this.page?.picture.pictureWidth()})}requestView({worldFromCamera:e,camera:n,intrinsics:r}){if(!this.isServerDrawn)return;let s=Math.min(1,Ah/r.width),[i,o]=[r.width,r.height].map(h=>Math.round(s*h)),a=Ao(e).map(h=>Math.round(1e4*h)/1e4),l=2*Math.atan(r.height/2/r.fy),u={type:"view",camera:n?.name??null,pose:a,width:i,height:o,fovy:l},g=JSON.stringify(u);g!==this.lastRequest&&this.send(u),this.lastRequest=g}control(e,n){this.send({type:"control",action:e,...n===void 0?{}:{speed:n}})}handlePilotKey(e){return this.pilot.handlePilotKey(e)}helpGroups(){return{Pilot:this.pilot.help()}}send(e){this.socket.readyState===WebSocket.OPEN&&this.socket.send(JSON.stringify(e))}receive(e){let{page:n,stream:r}=this;if(!n||!r)return;if(typeof e.data=="string")return this.handleMessage(JSON.parse(e.data),n,r);let s=new DataView(e.data),[i,o]=[s.getUint8(0),s.getUint8(1)];i===0&&location.reload(),i===1&&r.push(s.getFloat64(8,!0),new Float32Array(e.data,Xr)),i===2&&this.showImage(o,e.data.slice(Xr),n,r),i===4&&r.setSand(o,new Float32Array(e.data,Xr)),i===5&&this.addMedium(e.data.slice(Xr),n,r),i===3&&this.isServerDrawn&&this.showView(e.data.slice(Xr))}async addMedium(e,n,r){let s=await on(new Uint8Array(e));n.picture.media.add(s,s.head.optics),r.version+=1}handleMessage(e,n,r){if(e.type==="state")n.setState(e.paused,e.speed),this.allowsReset=e.resets,this.pilot.enable(e),n.views.follow(e.vehicle),n.keyboard.showHelp();else if(e.type==="levels")r.setLevels(e.levels);else if(e.type==="samples")for(let s of e.samples)r.sample(...s);else e.type==="readings"?r.version+=Number(n.quantities.setReadings(e.readings)):e.type==="topics"?this.topics.list(e.topics):e.type==="topic"?this.topics.showMessage(e):e.type==="markers"?r.setMarkers(e.markers):e.type==="end"&&this.end(e.why)}async showImage(e,n,r,s){let i=(this.imageNumbers[e]??0)+1;this.imageNumbers[e]=i;let o=await createImageBitmap(new Blob([n],{type:"image/jpeg"}));if(this.imageNumbers[e]!==i)return o.close();r.picture.show(e,o);let{end:a}=s;setTimeout(()=>{s.end===a&&(s.version+=1)},Mh)}showView(e){let n=N("stream");n.hidden=!1,Th(n,e)}end(e){N("message").textContent=e,this.page&&(this.page.isPlaying=!1)}};function Th(t,e){let n=t.src;t.src=URL.createObjectURL(new Blob([e],{type:"image/jpeg"})),n&&URL.revokeObjectURL(n)}function fl(t){let e=location.protocol==="https:"?"wss:":"ws:",n=new WebSocket(`${e}//${location.host}/socket${location.search}`);return n.binaryType="arraybuffer",new Promise((r,s)=>{let i=[],o=!1;n.onerror=n.onclose=()=>s(new Error("The simulation cannot be reached.")),n.onmessage=a=>{let{data:l}=a;if(o||typeof l=="string"||new DataView(l).getUint8(0)!==0){i.push(a);return}o=!0,on(new Uint8Array(l.slice(Xr))).then(u=>r(new Ci(n,u,i,t)),s)}})}var Rh=["clear","dusk","cloudy"],ts=.03,rs=class{constructor(e){this.page=e;let n=N("view");document.addEventListener("keydown",r=>this.onKeyDown(r)),n.addEventListener("keydown",r=>this.turnView(r)),n.addEventListener("pointerdown",r=>{if(r.target.closest("button, .stick"))return;n.setPointerCapture(r.pointerId);let s=r.button!==0||r.shiftKey;this.dragState={x:r.clientX,y:r.clientY,isPan:s}}),n.addEventListener("pointermove",r=>this.drag(r)),n.addEventListener("pointerup",()=>this.dragState=null),n.addEventListener("pointercancel",()=>this.dragState=null),n.addEventListener("contextmenu",r=>r.preventDefault()),n.addEventListener("wheel",r=>{r.preventDefault(),e.views.zoom(Math.exp(.001*r.deltaY))},{passive:!1}),this.showHelp()}page;dragState=null;showHelp(){Oo(this.groups())}drag(e){if(!this.dragState)return;let n=N("view").clientHeight,[r,s]=[e.clientX-this.dragState.x,e.clientY-this.dragState.y];this.page.views.drag(r/n,s/n,this.dragState.isPan),Object.assign(this.dragState,{x:e.clientX,y:e.clientY})}turnView(e){let r={ArrowLeft:[ts,0],ArrowRight:[-ts,0],ArrowUp:[0,ts],ArrowDown:[0,-ts]}[e.key];!r||e.ctrlKey||e.altKey||e.metaKey||(e.preventDefault(),e.stopPropagation(),this.page.views.drag(r[0],r[1],e.shiftKey))}onKeyDown(e){let{page:n}=this;if(e.ctrlKey||e.altKey||e.metaKey)return;let r=e.target;if((r instanceof HTMLSelectElement||r instanceof HTMLInputElement)&&!/^[a-z?]$/.test(e.key)||e.key===" "&&r instanceof HTMLButtonElement||/^(Home|End)$/.test(e.key)&&N("help").contains(r)||n.connection?.handlePilotKey(e))return;let i=e.shiftKey?e.key.toLowerCase():e.key,o=this.actions()[i];o&&(e.preventDefault(),o())}actions(){let{page:e}=this,n=s=>()=>{let i=e.player.levels.findIndex(({trial:o,level:a})=>o===e.player.trial&&a.end>e.time);e.go(Math.max(0,(i<0?e.player.levels.length-1:i)+s))},r=s=>()=>{e.switches.sun=Rh[s],e.draw()};return{" ":()=>e.play(),",":()=>e.step(-1),".":()=>e.step(1),ArrowLeft:()=>e.seek(e.time-1),ArrowRight:()=>e.seek(e.time+1),Home:()=>e.seek(e.player.start),End:()=>e.seek(e.player.end),"[":n(-1),"]":n(1),"<":()=>e.changeSpeed(-1),">":()=>e.changeSpeed(1),o:()=>e.show("orbit"),b:()=>e.show("chase"),v:()=>e.show("camera"),m:()=>e.show("map"),p:()=>e.show("file"),z:()=>e.toggle("state"),h:()=>e.views.restoreInitial(),k:()=>e.views.toggleFollowing(),r:()=>e.reset(),"+":()=>e.views.zoom(.9),"=":()=>e.views.zoom(.9),"-":()=>e.views.zoom(1.1),x:()=>e.toggle("clear"),c:()=>e.toggle("pictures"),f:()=>e.toggle("frames"),l:()=>e.toggle("labels"),t:()=>e.toggle("trails"),y:()=>e.clearTrails(),s:()=>e.toggle("sonars"),n:()=>e.toggleTheme(),1:r(0),2:r(1),3:r(2),"?":Nn}}groups(){let{page:e}=this,n=e.connection?"reset vehicles and objects":"start of the level",r=[{keys:", .",action:"one row back, forward"},{keys:"← →",action:"one second back, forward (in the view: rotate it)"},{keys:"[ ]",action:"previous, next level"},{keys:"Home End",action:"start, end"}],s={Time:[{keys:"space",action:"play, pause"},...e.connection?[{keys:".",action:"one step"}]:r,{keys:"< >",action:"slower, faster"},...e.connection&&!e.connection.allowsReset?[]:[{keys:"r",action:n}]],View:[{keys:"o b v m",action:"orbit, behind the vehicle, next camera, map from above"},...e.pack.head.file_view?[{keys:"p",action:"the camera of the scene file"}]:[],{keys:"k",action:"orbit follows the vehicle, or stays"},{keys:"arrows, drag",action:"rotate; with Shift or the right button: move"},{keys:"+ -, wheel",action:"nearer, farther"},{keys:"h",action:"first view"},{keys:"x",action:"clear water, or the scene's fog"},{keys:"1 2 3",action:"clear sky, dusk, cloudy"}],Shown:[{keys:"c",action:"images of the cameras"},{keys:"z",action:"state of the vehicle; a click on a number draws its curve"},{keys:"f l",action:"frames, names"},{keys:"t y",action:"trails; restart them"},{keys:"s",action:"beams and fans of sonars"},{keys:"n",action:"light or dark colours"},{keys:"?",action:"these keys"}]};if(!e.connection)return s;let i=e.connection.pilot;for(let o of Object.values(s).flat())o.keys=o.keys.split(" ").map(a=>i.isReserved(a)?`Shift+${a}`:a).join(" ");return{...s,...e.connection.helpGroups()}}};function dl({water:t,view:e}){let n=t.media?.[0];return n?Math.min(...n.absorption.map((s,i)=>s+n.scattering[i]))*Math.hypot(...e.at.map((s,i)=>s-e.pose[i]))>3:!0}var ns=class{entries=[];clearMedium;constructor(e){let{media:n,clear:r}=e.head.water;for(let s of n??[])this.add(e,s);this.clearMedium=r?hl(e,r):null}add(e,n){this.entries.length>=64&&this.entries.splice(1,1),this.entries.push(hl(e,n))}mediumAt(e){if(!this.entries.length)return null;let n=e.signal("beam_attenuation"),r=n===void 0?this.entries[0]:Lh(this.entries,n),s=e.signal("exposure_level");if(s===void 0)return r;let i=2**s/r.exposure;return{...r,exposure:2**s,clear_exposure:i*r.clear_exposure}}clearOptics(e){return e&&this.clearMedium&&{...this.clearMedium,exposure:e.clear_exposure}}};function Lh(t,e){let n=t.map(({absorption:r,scattering:s})=>Math.abs(r[1]+s[1]-e));return t[n.lastIndexOf(Math.min(...n))]}function hl(t,e){let n=t.numbers(e.transform.values);return{...e,transform:{...e.transform,values:n}}}var ml=200,pl=5,Oi=6e3,Ph=1200,Ni=180/Math.PI,ss=class{constructor(e,n){this.head=e;this.rays=n}head;rays;histories=new Map;readings=[];storeTime=-1/0;trial=-1;vehicle=0;setReadings(e){let n=JSON.stringify(e)!==JSON.stringify(this.readings);return this.readings=e,n}compute(e,n,r){this.vehicle=r;let s=this.readings.map(([i,o,a])=>({name:i,unit:o,value:a}));return[...this.motionQuantities(e,n),...s]}store(e,n){if(e<this.storeTime&&this.histories.clear(),!(e>=this.storeTime&&e<this.storeTime+1/pl)){this.storeTime=e;for(let{name:r,unit:s,value:i}of n){let o=this.historyOf(r,s);o.times.push(e),o.values.push(i),!(o.times.length<=Oi)&&(o.times.splice(0,Oi/2),o.values.splice(0,Oi/2))}}}history({name:e,unit:n},r){if(r.isLive)return this.historyOf(e,n);r.trial!==this.trial&&this.histories.clear(),this.trial=r.trial;let s=this.histories.get(e);if(s)return s;let i=this.historyOf(e,n),o=r.end-r.start,a=Math.max(2,Math.min(Ph,Math.ceil(o*pl)));for(let l=0;l<a;++l){let u=r.start+o*l/(a-1),g=this.motionQuantities(r.snapshot(u),r,e);i.times.push(u),i.values.push(g.find(h=>h.name===e)?.value??null)}return i}historyOf(e,n){let r=this.histories.get(e);return r||this.histories.set(e,r={name:is(e),unit:n,times:[],values:[]}),r}motionQuantities(e,n,r=""){let s=this.head.vehicles[this.vehicle];if(!s)return[];let i=gl(this.head,e,s.body),[o,a,l]=Pe(i),u=this.zAxisSign(s.body),g=Math.atan2(i[0],i[4])*Ni,h=[{name:"depth",unit:"m",value:this.head.water.surface_height-l},{name:"heading",unit:"deg",value:Math.round(10*(g+360))/10%360},{name:"roll",unit:"deg",value:Math.atan2(u*i[9],u*i[10])*Ni},{name:"pitch",unit:"deg",value:Math.asin(Math.max(-1,Math.min(1,i[8])))*Ni},{name:"speed",unit:"m/s",value:n.speed(s.body,e.time)}];(!r||r==="altitude")&&h.splice(1,0,{name:"altitude",unit:"m",value:this.altitude([o,a,l],s.name,e)});let p=["x","y","z"].map(_=>e.signal(`water/${s.name}/${_}`)??0),b=Math.hypot(...p);return(b>=.005||r)&&h.push({name:"current",unit:"m/s",value:b}),h}zAxisSign(e){let n=this.head.bodies.find(({name:r})=>r===e);return n&&st(n.pose)[10]<0?-1:1}altitude(e,n,r){let s=Se(e,[0,0,-ml]),i=a=>gl(this.head,r,a),o=this.rays.cast(e,s,i,a=>a.vehicle===n);return o<1?o*ml:null}};function gl(t,e,n){let r=t.bodies.find(({name:s})=>s===n);return e.poses.get(n)??st(r?.pose??[0,0,0,1,0,0,0])}function is(t){let[e,n]=[t.split("/")[0],t.slice(t.indexOf("/")+1)];return n===t||e==="joint"||n.toLowerCase().includes(e)?n:`${n} ${e}`}var vl=100,kh=["depth","speed"],Ih={deg:"°",1:"×"},os=class{constructor(e,n,r,s){this.quantities=e;this.player=n;this.redraw=s;this.curves=new er(N("state"),r)}quantities;player;redraw;cells=new Map;selection=new Set;curves;hasSelection=!1;displayTime=0;isUpdatePending=!1;lastState=null;values=[];show(e,n,r){this.lastState=[e,n,r];let s=performance.now();s-this.displayTime>=vl||!this.player.isLive?(this.displayTime=s,this.values=this.quantities.compute(e,this.player,n),this.player.isLive&&this.quantities.store(e.time,this.values),this.values.forEach(a=>this.fill(a))):this.isUpdatePending||(this.isUpdatePending=!0,setTimeout(()=>{this.isUpdatePending=!1,this.show(...this.lastState)},vl)),N("hud").hidden=!r||!this.values.length,!this.hasSelection&&this.values.length&&this.selectInitial();let o=this.selectedCurves();N("state-box").hidden=!o.length,o.length&&this.curves.show(e.time,o)}redrawCurves(){this.curves.redraw()}selectInitial(){this.hasSelection=!0,this.player.isLive&&!this.player.curves.length&&!this.player.levels.length&&kh.forEach(e=>this.selection.add(e)),this.mark()}selectedCurves(){return this.values.filter(({name:n})=>this.selection.has(n)).map(n=>this.quantities.history(n,this.player))}fill({name:e,unit:n,value:r}){let s=this.cells.get(e)??this.cell(e);s.value.textContent=Fh(r,n)}cell(e){let n=W("button","",e.startsWith("joint/")?"joint":""),r=W("output");n.append(W("span",is(e)),r),n.title=`${is(e)}: show or hide its curve`,n.addEventListener("click",()=>{this.selection.delete(e)||this.selection.add(e),this.hasSelection=!0,this.mark(),this.redraw()});let s={button:n,value:r};return this.cells.set(e,s),this.mark(),N("hud").append(n),s}mark(){for(let[e,{button:n}]of this.cells)n.setAttribute("aria-pressed",String(this.selection.has(e)))}};function Fh(t,e){if(t===null)return"–";let n={deg:1,m:2,"m/s":2,N:1,"%":0}[e]??2,r=t.toFixed(n).replace(/^-(0(\.0*)?)$/,"$1"),s=Ih[e]??` ${e}`;return`${r.replace("-","−")}${s}`}var Ch={orbit:["Orbit","Orbit around the vehicle (o)"],chase:["Chase","From behind the vehicle (b)"],camera:["Camera","Image of a camera (v)"],map:["Map","From above, north up (m)"],file:["File","From the <camera> of the scene file (p)"]},Oh={clear:["Clear water","Water without fog (x)"],state:["State","Depth, heading, joints and more; a click on a number draws its curve (z)"],pictures:["Cameras","Images of the cameras (c)"],frames:["Frames","Coordinate frames with their names (f)"],trails:["Trails","Trails of bodies (t)"],sonars:["Sonars","Beams and fans (s)"]};function bl(t,e,n){for(let s of e){let[i,o]=Ch[s],a=W("button",i);a.title=o,a.dataset.mode=s,a.setAttribute("role","radio"),a.addEventListener("click",()=>t.show(s)),N("modes").append(a)}let r=N("camera");n.forEach((s,i)=>r.append(new Option(s,String(i)))),r.addEventListener("change",()=>{t.views.camera=Number(r.value),t.refresh()})}function yl(t){let{sensors:e,cameras:n,vehicles:r}=t.pack.head,s={sonars:e.length,pictures:n.length,state:r.length};for(let[i,[o,a]]of Object.entries(Oh)){if(s[i]===0)continue;let l=W("button",o);l.dataset.switch=i,l.title=a,l.addEventListener("click",()=>t.toggle(i)),N("switches").append(l)}}function _l({views:t,switches:e,pack:n}){for(let s of N("modes").querySelectorAll("button"))s.setAttribute("aria-checked",String(s.dataset.mode===t.mode));for(let s of N("switches").querySelectorAll("button"))s.setAttribute("aria-pressed",String(e[s.dataset.switch]));let r=N("camera");r.hidden=t.mode!=="camera"||n.head.cameras.length<2,r.value=String(t.camera)}var wl=["orbit","chase","camera","map","file"],Nh=.9,Dh=.4,as=class{constructor(e,n,r){this.head=e;this.models=n;this.rays=r;this.orbit=Di(e.view),this.restoreInitial()}head;models;rays;mode="orbit";camera=0;version=0;vehicle=0;holdOffset=null;orbit;file=null;chaseAzimuth=0;height=12;mapOffset=[0,0];follow(e){e!==this.vehicle&&(this.vehicle=e,this.version+=1)}toggleFollowing(){this.holdOffset=this.holdOffset?null:this.displacement(),this.version+=1}restoreInitial(){this.version+=1,this.holdOffset=null,this.orbit=Di(this.head.view),this.file=this.head.file_view&&Di(this.head.file_view),this.chaseAzimuth=0,this.mapOffset.fill(0),this.height=Math.max(6,2*this.orbit.distance)}viewCamera(e,n){let{view:r,file_view:s}=this.head,i=Ro(e,n,(this.mode==="file"&&s?s:r).fovy),o=this.mode==="camera"?this.head.cameras[this.camera]:void 0;if(o){let l=Ui(o,e,n);return{worldFromCamera:this.models.worldFromMount(o),intrinsics:l,isExternal:!1,camera:o}}let a;if(this.mode==="map"){let[l,u]=Se(this.centre(),[...this.mapOffset,0]);a=$s([l,u,this.centre()[2]+this.height],[l,u,this.centre()[2]],[0,1,0])}else if(this.mode==="chase"&&this.base()){let l=this.base(),u=Math.atan2(l[4],l[0])+Math.PI+this.chaseAzimuth;a=this.chasePose(u,Math.max(.15,this.orbit.elevation))}else if(this.mode==="file"&&this.file)a=mn(this.file);else{let l=Se(this.orbit.target,this.holdOffset??this.displacement());a=mn({...this.orbit,target:l})}return{worldFromCamera:a,intrinsics:i,isExternal:!0,camera:null}}drag(e,n,r){if(this.version+=1,this.mode==="map"||r)return this.move(e,n);this.mode==="chase"?this.chaseAzimuth-=4*e:this.activeView().azimuth-=4*e;let s=this.activeView();s.elevation=Hi(s.elevation+3*n,-1.55,1.55)}zoom(e){this.version+=1,this.mode==="map"?this.height=Hi(this.height*e,.5,2e3):this.activeView().distance=Hi(this.activeView().distance*e,.1,2e3)}move(e,n){if(this.mode==="map"){let i=2*this.height*Math.tan(this.head.view.fovy/2);this.mapOffset[0]-=e*i,this.mapOffset[1]+=n*i;return}let r=this.activeView(),s=mn(r);r.target=Se(r.target,[s[0],s[4],s[8]],-e*r.distance),r.target=Se(r.target,[s[1],s[5],s[9]],n*r.distance)}activeView(){return this.mode==="file"&&this.file?this.file:this.orbit}chasePose(e,n){let r=this.centre(),{distance:s}=this.orbit,i=mn({target:r,azimuth:e,elevation:n,distance:s}),o=this.head.vehicles[this.vehicle].name,a=p=>this.models.body(p),l=.05*s,u=[[0,0],[l,0],[-l,0],[0,l],[0,-l]].map(([p,b])=>this.rays.cast(r,Le(i,[p,b,0]),a,_=>_.vehicle===o)),g=Math.min(...u);if(g>=1)return i;let h=Math.max(Math.min(Dh,s),Nh*g*s);return mn({target:r,azimuth:e,elevation:n,distance:h})}base(){let e=this.head.vehicles[this.vehicle];return e?this.models.body(e.body):null}displacement(){let e=this.head.vehicles[this.vehicle],n=this.head.bodies.find(({name:r})=>r===e?.body);return n?Se(this.centre(),n.pose.slice(0,3),-1):[0,0,0]}centre(){let e=this.base();return e?Le(e,[0,0,0]):this.head.view.at}};function Di(t){let e=Se(Pe(st(t.pose)),t.at,-1),n=Math.hypot(...e);return{target:[...t.at],azimuth:Math.atan2(e[1],e[0]),elevation:Math.asin(e[2]/n),distance:n}}function mn({target:t,azimuth:e,elevation:n,distance:r}){let[s,i]=[Math.cos(n),Math.sin(n)],o=_t([s*Math.cos(e),s*Math.sin(e),i]);return $s(Se(t,o,r),t)}function Ui(t,e,n){let r=Math.min(n/t.height,e/t.width);return{width:e,height:n,fx:t.fx*r,fy:t.fy*r,cx:(e-1)/2+(t.cx-(t.width-1)/2)*r,cy:(n-1)/2+(t.cy-(t.height-1)/2)*r,skew:t.skew*r,near:t.near,far:t.far}}function Hi(t,e,n){return Math.min(n,Math.max(e,t))}var xl=[.1,.25,.5,1,2,5,10,20],ls=class{constructor(e,n,r,s,i,o){this.pack=e;this.player=n;this.picture=r;this.views=s;this.connection=i;this.switches.clear=dl(e.head),this.quantities=new ss(e.head,o),this.hud=new os(this.quantities,n,a=>this.seek(a),()=>this.draw()),this.levels=new Cn(n,a=>{this.go(a)}),this.thrusters=new On(e.head),this.keyboard=new rs(this),this.build(),requestAnimationFrame(a=>this.tick(a))}pack;player;picture;views;connection;time=0;isPlaying=!1;speed=1;switches={clear:!0,pictures:!0,state:!0,frames:!1,labels:!1,trails:!0,sonars:!0,sun:""};curves=new er(N("curves"),e=>this.seek(e));quantities;hud;levels;thrusters;keyboard;lastTick=performance.now();drawnKey="";note="";async go(e){let n=this.player.levels[e];!n||this.connection||(await this.select(n.trial),this.seek(n.level.start))}async select(e){if(e===this.player.trial)return;await this.player.select(e),N("message").textContent=Co(this.player)?"This trial has no recorded motion.":this.note,this.curves.set(this.player.curves);let{start:n,end:r}=this.player;this.levels.mark(n,r),Object.assign(N("time"),{min:String(n),max:String(r)})}seek(e){this.connection||(this.time=Math.min(this.player.end,Math.max(this.player.start,e)),this.draw())}play(e=!this.isPlaying){this.isPlaying=e,e&&!this.connection&&this.time>=this.player.end-1e-6&&(this.time=this.player.start),this.connection?.control(e?"play":"pause"),N("play").textContent=e?"Pause":"Play"}step(e){this.play(!1),this.connection?this.connection.control("step"):this.seek(this.time+e/30)}reset(){this.connection?this.connection.control("reset"):this.seek(this.player.levels[fr(this.player,this.time)]?.level.start??this.player.start)}setSpeed(e,n=!0){this.speed=e;let r=N("speed");[...r.options].some(({value:s})=>s===String(e))||r.append(El(e)),r.value=String(e),n&&this.connection?.control("speed",e)}setState(e,n){this.isPlaying=!e,N("play").textContent=e?"Play":"Pause",this.setSpeed(n,!1)}changeSpeed(e){let n=i=>i||1/0,r=this.speeds().filter(i=>(n(i)-n(this.speed))*e>0),s=e>0?r[0]:r.at(-1);s!==void 0&&this.setSpeed(s)}speeds(){return this.connection?[...xl,0]:xl}show(e){this.modes().includes(e)&&(e==="camera"&&this.views.mode==="camera"&&(this.views.camera=(this.views.camera+1)%this.pack.head.cameras.length),this.views.mode=e,this.refresh())}modes(){let{cameras:e,file_view:n}=this.pack.head;return wl.filter(r=>(r!=="camera"||e.length)&&(r!=="file"||n))}toggle(e){this.switches[e]=!this.switches[e],e==="frames"&&(this.switches.labels=this.switches.frames),this.connection?.subscribe(this.switches.pictures),this.refresh()}clearTrails(){this.player.clearTrails(this.time),this.draw()}toggleTheme(){let e=document.documentElement;e.dataset.theme=e.dataset.theme==="dark"?"light":"dark",this.curves.redraw(),this.hud.redrawCurves(),this.connection?.topics.redrawCurves()}draw(){this.player.isLive&&(this.time=this.player.end);let e=this.player.snapshot(this.time);this.hud.show(e,this.views.vehicle,this.switches.state);let n=this.picture.draw(this.player,e,this.views,this.switches);n&&this.connection?.requestView(n),this.levels.show(this.time),this.curves.show(this.time,this.player.curves),N("curves-box").hidden=!this.player.curves.length,this.connection?.topics.show(this.time),this.thrusters.show(e);let r=[...document.querySelectorAll("aside > section")];document.body.classList.toggle("bare",r.every(({hidden:s})=>s)),N("time").value=String(this.time),N("clock").textContent=this.player.isLive?`${this.time.toFixed(2)} s`:`${this.time.toFixed(2)} / ${this.player.end.toFixed(2)} s`}tick(e){requestAnimationFrame(a=>this.tick(a));let n=Math.min(.25,(e-this.lastTick)/1e3);this.lastTick=e,this.isPlaying&&!this.connection&&(this.time=Math.min(this.player.end,this.time+n*this.speed),this.time>=this.player.end&&this.play(!1));let{clientWidth:r,clientHeight:s}=this.picture.canvas,o=[this.time,this.player.end,r,s,this.views.version,this.player.version].join()+JSON.stringify(this.switches);o!==this.drawnKey&&!document.hidden&&this.picture.isReady()&&(this.drawnKey=o,this.draw())}refresh(){_l(this),this.draw()}build(){bl(this,this.modes(),this.pack.head.cameras.map(({name:r})=>r)),yl(this);let e=N("speed");e.append(...this.speeds().map(El)),e.addEventListener("change",()=>this.setSpeed(Number(e.value))),this.setSpeed(1,!1);let n=N("time");n.addEventListener("input",()=>this.seek(Number(n.value))),N("play").addEventListener("click",()=>this.play()),N("step").addEventListener("click",()=>this.step(1)),N("back").addEventListener("click",()=>this.step(-1)),N("back").hidden=N("line").hidden=this.player.isLive,N("help-button").addEventListener("click",Nn),this.refresh()}};function El(t){return new Option(t?`${t}×`:"fastest",String(t))}var cs=class{constructor(e,n){this.heap=e;this.positions=n;this.initialHeights=Float32Array.from({length:n.length/3},(r,s)=>n[3*s+2]-e.corner[2]),this.heights=this.initialHeights.slice()}heap;positions;heights;initialHeights;removals=[];lastHeights=null;set(e){return e===this.lastHeights?!1:(this.lastHeights=e,this.heights.set(e.subarray(0,this.heights.length)),!0)}apply(e){let n=this.removals,r=e.length>=n.length&&n.every((s,i)=>s===e[i]);if(r&&e.length===n.length)return!1;r||this.heights.set(this.initialHeights);for(let{position:s}of r?e.slice(n.length):e)s?this.remove(s):this.heights.set(this.initialHeights);return this.removals=e,!0}surface(){let{heap:e,heights:n}=this,[r,s]=e.columns,i=Float32Array.from(this.positions),o=new Int16Array(i.length),a=(l,u,g)=>{let[h,p]=[Math.max(0,l-1),Math.min(u-1,l+1)];return(g(p)-g(h))/((p-h)*e.cell)};for(let l=0;l<r;++l)for(let u=0;u<s;++u){let g=l*s+u,h=a(l,r,_=>n[_*s+u]),p=a(u,s,_=>n[l*s+_]),b=32767/Math.hypot(h,p,1);i[3*g+2]=e.corner[2]+n[g],o.set([-h*b,-p*b,b],3*g)}return{positions:i,normals:o}}remove([e,n,r]){let{heap:s,heights:i}=this,[o,a]=s.columns,l=s.reach**2,u=(_,w)=>[Math.max(0,Math.floor((_-s.reach)/s.cell)),Math.min(w-1,Math.ceil((_+s.reach)/s.cell))],[[g,h],[p,b]]=[u(e,o),u(n,a)];for(let _=g;_<=h;++_)for(let w=p;w<=b;++w){let A=_*a+w;(_*s.cell-e)**2+(w*s.cell-n)**2+(i[A]-r)**2<l&&(i[A]=Math.max(0,i[A]-s.bite))}}};var Sl=`// Provides: pixels without a surface: the water's far colour, range inf, id 0.
// Needs: frame.glsl, grey.glsl, targets.glsl.
// The far colour is the limit of the water's image model at infinite distance.
#include "frame.glsl"
#include "grey.glsl"
#ifdef PHYSICAL
#include "optics.glsl"
#endif
#include "targets.glsl"

void main() {
#ifdef COLOUR
#ifdef PHYSICAL
    colour_out = vec4(0.0, 0.0, 0.0, FAR);
#else
    colour_out = vec4(camera_colour(background.rgb), 1.0);
#endif
#endif
#ifdef RANGE
    range_out = uintBitsToFloat(0x7f800000u);
#endif
#ifdef IDS
    id_out = 0u;
#endif
}
`;var Ml=`// Provides: one triangle over the whole image at the far plane.
// Needs: nothing; three vertices without attributes.
// Depth 1 passes only where nothing has been drawn.
void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 1.0, 1.0);
}
`;var Al=`// Provides: the Gaussian of a level of blur along its columns, plus the wider levels; at the first level, plus the lamps' veil.
// Needs: gaussian.glsl; the level after its rows; with WIDER, the sum of the wider levels at half the resolution; with LAMPS,
// the number of lamps: optics.glsl, lamps.glsl, lamp_veil.glsl, and the mean light, whose alpha is the range. With VEIL_ONLY there
// is no level.
#include "gaussian.glsl"
uniform sampler2D level_0;
#ifdef WIDER
uniform sampler2D level_1;
#endif
#ifdef LAMPS
#include "optics.glsl"
#include "lamps.glsl"
#include "lamp_veil.glsl"
uniform sampler2D level_2;
#endif
out vec4 light_out;

void main() {
#ifdef VEIL_ONLY
    vec3 sum = vec3(0.0);
#else
    vec3 sum = gaussian(level_0, ivec2(0, 1)).rgb;
#endif
#ifdef WIDER
    sum += textureLod(level_1, gl_FragCoord.xy / (2.0 * vec2(textureSize(level_1, 0))), 0.0).rgb;
#endif
#ifdef LAMPS
    float range = texelFetch(level_2, ivec2(gl_FragCoord.xy), 0).a;
    vec2 pixel = 2.0 * gl_FragCoord.xy;
    vec3 ray = normalize(ray_first.xyz + pixel.x * ray_column.xyz + pixel.y * ray_row.xyz);
    for (int i = 0; i < LAMPS; ++i) sum += lamp_veil(i, ray, range);
#endif
    light_out = vec4(sum, 1.0);
}
`;var Tl=`// Provides: the Gaussian of a level of blur along its rows.
// Needs: gaussian.glsl; the texture of the level.
// blurred.frag.glsl adds that along the columns.
#include "gaussian.glsl"
uniform sampler2D level_0;
out vec4 light_out;

void main() {
    light_out = gaussian(level_0, ivec2(1, 0));
}
`;var Rl=`// Provides: caustic_excess(place, depth, depths, swell_frame), the gain of the sun's beam by the moving surface, minus 1.
// Needs: the maps of caustics/caustic_map.py; with SWELL the grid of caustics/swell.py; place: where the beam enters, in tiles.
// The light of one depth is interpolated between two maps. Above the first it is linear, and far below the last contrast falls.
uniform sampler2DArray caustic_maps;
#ifdef SWELL
uniform sampler2D swell_map;
#endif

#ifdef MAP_LEVEL
#define READ_MAP(place, index) textureLod(caustic_maps, vec3(place, index), map_level)
float caustic_excess(vec2 place, float depth, vec4 depths, vec4 frame, float map_level) {
#else
#define READ_MAP(place, index) texture(caustic_maps, vec3(place, index))
float caustic_excess(vec2 place, float depth, vec4 depths, vec4 frame) {
#endif
    float z = max(depth, 0.0);
    float density = 1.0;
#ifdef SWELL
    vec4 swell = textureLod(swell_map, place * frame.z + frame.xy, 0.0);
    vec2 inside = step(abs(place * frame.z + frame.xy - 0.5), vec2(0.5));
    density = 1.0 - z * (swell.z - z * swell.w) * inside.x * inside.y;
    place -= z * frame.w * swell.xy;
#endif
    float level = clamp(log2(max(z, depths.x)) * depths.y + depths.z, 0.0, float(N_SLICES - 1));
    float layer = step(0.5 * float(N_SLICES), level);  // of the maps 0 to 3, or 2 to 5
    vec4 shares = max(1.0 - abs(vec4(0.0, 1.0, 2.0, 3.0) + 2.0 * layer - level), 0.0);
    float excess = dot(READ_MAP(place, layer), shares);
    float far = depths.w / max(z, depths.w);
    return (1.0 + excess * min(z / depths.x, 1.0) * far * far) * density - 1.0;
}
`;var Ll=`// Provides: the block Caustics, the numbers of caustics that are constant in an image.
// Needs: nothing. Filled by caustics/caustic_light.py, where the same members are declared.
// A tile is the unit of length of maps.
layout(std140) uniform Caustics {
    vec4 caustic_x;       // place where the beam to a point in the camera frame enters: x of W = xyz * point + w [tiles]
    vec4 caustic_y;       // the same for y of W
    vec4 swell_frame;     // xy, z: coordinates in the grid of long waves = z * place + xy; w: tiles in a metre
    vec4 caustic_depths;  // x: first depth [m]; y, z: index of a map = y log2(depth) + z; w: last depth [m]
    vec4 caustic_loss;    // rgb: rate at which the contrast falls with depth [1/m]; w: greatest b p / (b* p*) in shafts on the way to the surface
    vec4 shaft_numbers;   // x: asymmetry of p*; y: b* / b; z: longest way [m]; w: texels in a tile
};
`;var Pl=`// Provides: daylight(facing, up_cosine, share, depth), the light of sun and sky under water; albedo_of(stored), a surface's albedo.
// Needs: varyings.glsl with PHYSICAL; facing = N.L; up_cosine = N.up; share = 0 in the sun's shadow to 1; depth below the surface [m].
// physical/daylight_field.py, physical/transfer_curve.py: the sun's beam, with CAUSTICS focused by waves; diffuse light from above, light from below.
#ifdef CAUSTICS
#include "caustics.glsl"
#endif
vec3 daylight(float facing, float up_cosine, float share, float depth) {
    float z = max(depth, 0.0);
    vec3 total = v_daylight_total * exp(v_daylight_loss * -z);
    vec3 level = min(v_sun_beam.rgb * exp(v_sun_loss * -z), total);
    vec3 diffuse = total - level;
#ifdef CAUSTICS
    level *= 1.0 + exp(v_caustic_loss * -z) * caustic_excess(v_caustic_place, depth, v_caustic_depths, v_swell_frame);
#endif
    return level * (max(facing, 0.0) * share / v_sun_beam.w)
        + diffuse * (0.5 + 0.5 * up_cosine) + v_upwelling * total * (0.5 - 0.5 * up_cosine);
}

vec3 albedo_of(vec3 stored) {
    vec3 root = sqrt(stored);
    return stored * (0.0982065878 + root * (-0.2653148210 + root * (0.7011382242 + root * (0.5186992531 - 0.0527292441 * root))));
}
`;var kl=`// Provides: the stored colours of an image through physical water: direct light, blur, veil, exposure, curve.
// Needs: optics.glsl, transmission.glsl, open_water.glsl, grey.glsl; the image of the surfaces; with SCATTERED, the sum of the
// levels; with PARTICLES, the image of the particles; with SHAFTS, the edge of a texel [px], that of the shafts; the switches BLUR,
// LINEAR for no curve, and LIGHT for no exposure either.
// B + D (J - B) + blur + veil: physical/development.py; the curve: physical/transfer_curve.py.
#include "optics.glsl"
#include "transmission.glsl"
#include "open_water.glsl"
#include "grey.glsl"
uniform sampler2D surface_image;
#ifdef SCATTERED
uniform sampler2D level_0;
#endif
#ifdef PARTICLES
uniform sampler2D particle_image;
#endif
#ifdef SHAFTS
uniform sampler2D shaft_image;
#endif
#ifdef CLOUDS
#include "clouds.glsl"
#include "cloud_edge.glsl"
uniform sampler2D cloud_layers_map;
uniform sampler2D cloud_lamplight_map;
uniform sampler2D cloud_daylight_map;

vec3 through_clouds(vec3 light, vec3 water, float range) {
    vec2 place = gl_FragCoord.xy / (float(CLOUD_EDGE) * vec2(textureSize(cloud_layers_map, 0)));
    vec4 layers = textureLod(cloud_layers_map, place, 0.0);
    vec4 lamplight = textureLod(cloud_lamplight_map, place, 0.0);
    vec3 daylight = textureLod(cloud_daylight_map, place, 0.0).rgb;
    vec4 shares = clamp((range - cloud_layers.x) / cloud_layers.y - vec4(0.0, 0.0, 1.0, 2.0), 0.0, 1.0);
    float depth = layers.x + dot(shares.yzw, layers.yzw - layers.xyz);
    vec3 mean = 1.0 / max(vec3(lamplight.a), 1e-6);
    vec3 veil = mean * lamplight.rgb * ((1.0 - exp(-LOSS_SHARE * depth)) / LOSS_SHARE);
    return mix(water + mean * daylight, light, exp(-depth)) + veil;
}
#endif
out vec4 colour_out;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    ivec2 size = textureSize(surface_image, 0);
    vec4 texel = texelFetch(surface_image, pixel, 0);
    vec3 water = open_water(gl_FragCoord.xy, vec2(size));
    vec3 light = water;
#ifdef SHAFTS
    light += textureLod(shaft_image, gl_FragCoord.xy / (float(SHAFTS) * vec2(textureSize(shaft_image, 0))), 0.0).rgb;
#endif
    float is_surface = texel.a < 0.5 * FAR ? 1.0 : 0.0;
    float range = texel.a * is_surface;
    vec3 excess = (texel.rgb - water) * is_surface;
#ifdef BLUR
    vec3 sharp = direct(range) + weight(0, range);
#else
    vec3 sharp = whole_field(range);
#endif
#ifdef PARTICLES
    vec4 particles = texelFetch(particle_image, pixel, 0);
    excess *= 1.0 - min(particles.a, 1.0);
    light += particles.rgb;
#endif
    light += sharp * excess;
#ifdef SCATTERED
    light += textureLod(level_0, gl_FragCoord.xy / (2.0 * vec2(textureSize(level_0, 0))), 0.0).rgb;
#endif
#ifdef CLOUDS
    light = through_clouds(light, water, is_surface > 0.5 ? range : FAR);
#endif
#ifdef LIGHT
    colour_out = vec4(light, 1.0);
#else
    vec3 value = clamp(light * camera.y, 0.0, 1.0);
#ifndef LINEAR
    vec3 second = sqrt(value);
    vec3 fourth = sqrt(second);
    vec3 curve = 0.642363 * second + 0.71211342 * fourth - 0.33687116 * sqrt(fourth) - 0.01756212 * value;
    value = mix(12.92 * value, curve, step(0.0031308, value));
#endif
    colour_out = vec4(camera_colour(value), 1.0);
#endif
}
`;var Il=`// Provides: the block Frame: values that are constant in an image.
// Needs: nothing. Filled by frame.py, where the same members are declared.
// Camera frame: OpenGL axes (x right, y up, -z ahead), metres.
layout(std140) uniform Frame {
    mat4 clip_from_camera;
    mat4 shadow_from_camera;  // to texture coordinates and depth, 0..1
    vec4 up;                  // xyz: W's z axis, camera frame; w: camera's height above the water [m]
    vec4 sun;                 // xyz: towards the sun, camera frame; w: offset along normals against self-shadowing [m]
    vec4 sunlight;            // rgb: colour of the sun times the light rate
    vec4 ambient_specular;    // x: ambient, y: specular brightness, both times the light rate
    vec4 water_colour;        // rgb: colour of in-scattered light
    vec4 attenuation;         // rgb [1/m]
    vec4 fog;                 // rgb: colour; w: density squared [1/m2]
    vec4 clip_fog;            // clip-space z, the distance in UWSim's fog = x * planar depth + y [m]
    vec4 background;          // rgb: colour of pixels without a surface
};
`;var Fl=`// Provides: gaussian(level, step), the Gaussian of a level at this texel along step, (1, 0) or (0, 1).
// Needs: the switches RADIUS [texels] and SPREAD, a thousand times the standard deviation [texels].
// Outside the level its edge is continued.
vec4 gaussian(sampler2D level, ivec2 step_) {
    ivec2 last = textureSize(level, 0) - 1;
    ivec2 texel = ivec2(gl_FragCoord.xy);
    vec4 sum = texelFetch(level, texel, 0);
#if RADIUS > 0
    const float rate = 500000.0 / (float(SPREAD) * float(SPREAD));
    float total = 1.0;
    for (int i = 1; i <= RADIUS; ++i) {
        float weight = exp(-rate * float(i * i));
        sum += weight * (texelFetch(level, clamp(texel - i * step_, ivec2(0), last), 0)
            + texelFetch(level, clamp(texel + i * step_, ivec2(0), last), 0));
        total += 2.0 * weight;
    }
    sum /= total;
#endif
    return sum;
}
`;var Cl=`// Provides: camera_colour(colour), the colour of a pixel in the image of a colour or grey camera.
// Needs: nothing.
// With the switch GREY: int(0.2989 R) + int(0.5870 G) + int(0.1140 B) of 8-bit values, as in grey.py. Only the viewer's page sets it.
vec3 camera_colour(vec3 colour) {
#ifdef GREY
    vec3 stored = floor(clamp(colour, 0.0, 1.0) * 255.0 + 0.5);
    vec3 terms = floor(stored * vec3(0.2989, 0.5870, 0.1140) + 5e-5);
    return vec3((terms.r + terms.g + terms.b) / 255.0);
#else
    return colour;
#endif
}
`;var Ol=`// Provides: the block Instance: the pose of one instance in the camera frame, and its id.
// Needs: nothing. Filled by instance.py, where the same members are declared.
// camera_normals is the inverse transpose of camera_from_model (scale may be uneven).
layout(std140) uniform Instance {
    mat4 camera_from_model;
    mat4 camera_normals;
    uvec4 identity;  // x: id, 1..65535
};
`;var Nl=`// Provides: the radiance of a lamp that the camera sees, and its range.
// Needs: optics.glsl, targets.glsl with COLOUR; the outputs of lamp_point.vert.glsl. The renderer adds radiance and replaces range.
// pi I lobe / (d^2 Omega) with the solid angle Omega of a pixel, divided among the four pixels around the lamp.
#include "optics.glsl"
#include "targets.glsl"
flat in vec3 v_position;
flat in vec3 v_axis;
flat in vec4 v_light;
flat in float v_steepness;

void main() {
    float range = max(length(v_position), 0.01);
    float cosine = dot(v_axis, v_position) / range;
    float share = v_light.w > -1.0 ? clamp((cosine - v_light.w) * v_steepness, 0.0, 1.0) : 1.0;
    vec2 slope = v_position.xy / -v_position.z - ray_first.xy;
    float row = slope.y / ray_row.y;
    float column = (slope.x - row * ray_row.x) / ray_column.x;
    vec2 weight = max(1.0 - abs(gl_FragCoord.xy - vec2(column, row)), 0.0);
    float part = weight.x * weight.y * share * share * (3.0 - 2.0 * share);
    if (part <= 0.0) discard;
    float axis_cosine = -v_position.z / range;
    float solid_angle = axis_cosine * axis_cosine * axis_cosine * abs(ray_column.x * ray_row.y);
    colour_out = vec4(v_light.rgb * (3.14159265 * part / (range * range * solid_angle)), range);
}
`;var Dl=`// Provides: a point of 3 x 3 pixels where the camera sees a lamp.
// Needs: frame.glsl, lamps.glsl with LAMPS; a vertex for each lamp, without attributes.
// The depth is that of a point 0.1 m nearer, so that a lamp's own housing does not hide it.
#include "frame.glsl"
#include "lamps.glsl"
flat out vec3 v_position;  // of the lamp, camera frame [m]
flat out vec3 v_axis;
flat out vec4 v_light;     // rgb: intensity times colour; w: cosine at the edge of the cone
flat out float v_steepness;

void main() {
    int i = gl_VertexID;
    v_position = lamp_position[i].xyz;
    v_axis = lamp_axis[i].xyz;
    v_light = vec4(lamp_light[i].rgb, lamp_position[i].w);
    v_steepness = lamp_axis[i].w;
    gl_Position = clip_from_camera * vec4(v_position, 1.0);
    float range = max(length(v_position), 1e-3);
    vec4 nearer = clip_from_camera * vec4(v_position * max(1.0 - 0.1 / range, 0.5), 1.0);
    if (gl_Position.w > 0.0 && nearer.w > 0.0) gl_Position.z = nearer.z / nearer.w * gl_Position.w;
    gl_PointSize = 3.0;
}
`;var Hl=`// Provides: lamp_veil(i, ray, range), the light of a lamp that the water scatters into the camera along a unit ray.
// Needs: optics.glsl, lamps.glsl with LAMPS. optics/lamp_light.py has the formulas; no shadows.
// With u = tan(pi/4 + eta/2): cos(eta) = 2u / (1 + u^2), sin(eta) = (u^2 - 1) / (1 + u^2), t + d = t0 + h u.
vec3 veil_sample(float u, float weight, float foot, float height, float foot_axis, float ray_axis, int i, vec3 loss) {
    u = u >= 0.0 ? min(u, 1e5) : 1e5;  // rounding at far points of the ray
    float square = u * u;
    float inverse = 1.0 / (1.0 + square);
    float cosine = 2.0 * u * inverse;
    float sine = 1.0 - 2.0 * inverse;
    float share = clamp((foot_axis * cosine + ray_axis * sine - lamp_position[i].w) * lamp_axis[i].w, 0.0, 1.0);
    float q = sqrt(sqrt(square * inverse));
    vec4 even = phase_high;
    float log_phase = even.w;
    log_phase = log_phase * q + even.z;
    log_phase = log_phase * q + even.y;
    log_phase = log_phase * q + even.x;
    log_phase = log_phase * q + phase_low.w;
    log_phase = log_phase * q + phase_low.z;
    log_phase = log_phase * q + phase_low.y;
    log_phase = log_phase * q + phase_low.x;
    return exp(log_phase - loss * (foot + height * u)) * (weight * share * share * (3.0 - 2.0 * share));
}

vec3 lamp_veil(int i, vec3 ray, float range) {
    vec3 to_lamp = lamp_position[i].xyz;
    vec3 axis = -lamp_axis[i].xyz;
    float foot = dot(ray, to_lamp);
    vec3 foot_vector = foot * ray - to_lamp;
    float height = max(length(foot_vector), 1e-3);
    float begin = 0.0;
    float end = range;
    float ray_axis = dot(ray, axis);
    if (lamp_optics[i].w > 0.5) {
        // A t^2 + 2 B t + C >= 0 is the inside of the cone and of its mirror image behind the lamp.
        float origin = -dot(to_lamp, axis);
        float a = ray_axis * ray_axis - lamp_optics[i].z;
        a = abs(a) < 1e-7 ? 1e-7 : a;
        float b = ray_axis * origin + lamp_optics[i].z * foot;
        float c = origin * origin - lamp_optics[i].z * dot(to_lamp, to_lamp);
        float discriminant = b * b - a * c;
        float root = sqrt(max(discriminant, 0.0));
        float first = (-b - root) / a;
        float second = (-b + root) / a;
        float near = min(first, second);
        float far = max(first, second);
        bool is_lit = true;
        if (a > 0.0) {
            begin = ray_axis > 0.0 ? max(far, 0.0) : 0.0;
            end = ray_axis > 0.0 ? end : min(end, near);
        } else {
            is_lit = discriminant > 0.0 && origin + 0.5 * (near + far) * ray_axis > 0.0;
            begin = max(near, 0.0);
            end = min(end, far);
        }
        if (!is_lit || end <= begin) return vec3(0.0);
    }
    // Light that a lamp sends to the camera and the water scatters forward is in the blur of the lamp's own image.
    float cosine = dot(lamp_axis[i].xyz, to_lamp) / max(length(to_lamp), 1e-3);
    float direct_share = lamp_position[i].w > -1.0 ? clamp((cosine - lamp_position[i].w) * lamp_axis[i].w, 0.0, 1.0) : 1.0;
    begin = max(begin, mix(begin, foot, direct_share));
    if (end <= begin) return vec3(0.0);
    float low = atan((begin - foot) / height);
    float high = atan((end - foot) / height);
    float half_width = 0.25 * (high - low);
    float middle = tan(0.78539816 + 0.25 * (high + low));
    float inner = tan(0.3399810435848563 * half_width);
    float outer = tan(0.8611363115940526 * half_width);
    float foot_axis = dot(foot_vector, axis) / height;
    vec3 loss = absorption.rgb + 0.03 * scattering.rgb;  // c - 0.97 b
    vec3 sum = veil_sample(max(middle - outer, 0.0) / (1.0 + middle * outer), 0.3478548451374538, foot, height, foot_axis, ray_axis, i, loss)
        + veil_sample(max(middle - inner, 0.0) / (1.0 + middle * inner), 0.6521451548625461, foot, height, foot_axis, ray_axis, i, loss)
        + veil_sample((middle + inner) / (1.0 - middle * inner), 0.6521451548625461, foot, height, foot_axis, ray_axis, i, loss)
        + veil_sample((middle + outer) / (1.0 - middle * outer), 0.3478548451374538, foot, height, foot_axis, ray_axis, i, loss);
    return scattering.rgb * lamp_light[i].rgb * sum * (6.283185307 * half_width / height);  // pi b I (high - low) / 2 / h
}
`;var Ul=`// Provides: lamplight(colour, unit_normal), the light of the lamps that a surface reflects.
// Needs: varyings.glsl and lamps.glsl with LAMPS; their shadow maps, four tiles of one texture.
// With MICROFACET, material.glsl replaces the colour.
// colour k I max(N.D, 0) / d^2 cone exp(-a d) * share of the light that no body blocks: see lamp.py.
uniform sampler2DShadow lamp_maps;

vec3 lamplight(vec3 colour, vec3 unit_normal) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < LAMPS; ++i) {
        vec3 towards = lamp_position[i].xyz - v_position;
        float distance = max(length(towards), 0.01);
        float facing = dot(unit_normal, towards) / distance;
        float cosine = dot(lamp_axis[i].xyz, towards) / distance;
        float cone_position = clamp((cosine - lamp_position[i].w) * lamp_axis[i].w, 0.0, 1.0);
        if (facing > 0.0 && cone_position > 0.0) {
            float cone = cone_position * cone_position * (3.0 - 2.0 * cone_position);
            float share = 1.0;  // a lamp that shines in all directions casts no shadows
            if (lamp_position[i].w > -1.0)
                share = textureLod(lamp_maps, v_lamp_uv[i].xyz / v_lamp_uv[i].w, 0.0);
#ifdef PHYSICAL
            // c - b e of a wide target, as optics/lamp_light.py has it for the way there
            vec3 energy = lamp_optics[i].x - lamp_optics[i].y * sqrt(absorption.rgb * (2.0 * distance));
            vec3 transmission = exp((absorption.rgb + scattering.rgb * (1.0 - energy)) * -distance);
#else
            vec3 transmission = exp(v_attenuation * -distance);
#endif
            vec3 arriving = lamp_light[i].rgb * transmission * (facing * cone * share / (distance * distance));
#ifdef MICROFACET
            arriving *= reflected_share(unit_normal, towards / distance, facing);
#endif
            sum += arriving;
        }
    }
#ifdef MICROFACET
    return sum;
#else
    return colour * sum;
#endif
}
`;var Gl=`// Provides: the block Lamps: the lamps of the vehicles.
// Needs: the switch LAMPS, the number of lamps, 1..4. Filled by lamps.py, where the same members are declared.
// Camera frame: OpenGL axes, metres.
layout(std140) uniform Lamps {
    mat4[4] lamp_from_camera;  // to homogeneous texture coordinates and depth in the shadow maps
    vec4[4] lamp_position;     // xyz [m]; w: cosine at the edge of the cone
    vec4[4] lamp_axis;         // xyz: opposite to the beam; w: factor from cosines inside the edge to 0..1
    vec4[4] lamp_light;        // rgb: intensity times colour; w: offset along normals against self-shadowing, per metre of distance [1]
};
`;var Vl=`// Provides: with NORMAL_MAP, mapped_normal(unit_normal); with MICROFACET, prepare_material, material_daylight, reflected_share.
// Needs: varyings.glsl; with MICROFACET: daylight.glsl, the table of reflectance.py, and with FINISH_MAP a map of occlusion, roughness, metal.
// pi times the BRDF of a rough surface: Lambert under a layer of GGX's microfacets: reflectance.py.
#ifdef NORMAL_MAP
uniform sampler2D normal_map;

vec3 mapped_normal(vec3 unit_normal) {
    vec3 local = texture(normal_map, v_uv).xyz * (255.0 / 127.5) - 1.0;
    vec3 outward = gl_FrontFacing ? unit_normal : -unit_normal;
    vec3 across = cross(outward, v_tangent.xyz) * v_tangent.w;
    vec3 mapped = v_finish.z * (local.x * v_tangent.xyz + local.y * across) + local.z * outward;
    mapped *= inversesqrt(max(dot(mapped, mapped), 1e-12));
    return gl_FrontFacing ? mapped : -mapped;
}
#endif
#ifdef MICROFACET
#define MIN_ROUGHNESS 0.08  // these are the constants of reflectance.py; the indices are squared and relative to the medium
#define WATER_INDEX 1.2530631
#define AIR_INDEX 2.25
uniform sampler2D reflectance_table;
#ifdef FINISH_MAP
uniform sampler2D finish_map;
#endif
vec3 surface_view;      // towards the camera
vec3 surface_diffuse;   // albedo below the layer, times the light that passes the layer
vec3 surface_metal;     // colour of metal
vec3 surface_gain;      // factor on its reflection for light that microfacets reflect several times
vec4 surface_finish;    // x: roughness; y: share of metal; z: squared width; w: n.v
vec2 surface_factors;   // x: squared relative index of a dielectric; y: share of the diffuse daylight that arrives
vec3 surface_mirror;    // reflectance of the layer under even light

// Fresnel's reflectance of a dielectric, or Schlick's of a metal, from the cosine of incidence.
vec3 fresnel(float cosine) {
    float g = sqrt(surface_factors.x - 1.0 + cosine * cosine);
    float minus = g - cosine;
    float plus = g + cosine;
    float ratio = minus / plus;
    float second = (cosine * plus - 1.0) / (cosine * minus + 1.0);
    float dielectric = 0.5 * ratio * ratio * (1.0 + second * second);
    float rest = 1.0 - cosine;
    float power = rest * rest;
    power *= power * rest;
    return mix(vec3(dielectric), surface_gain * (surface_metal + (1.0 - surface_metal) * power), surface_finish.y);
}

// Set the variables above for a pixel; call it before the functions below.
void prepare_material(vec3 albedo, vec3 normal, float depth) {
    float roughness = v_finish.x;
    float metallic = v_finish.y;
    float occlusion = 1.0;
#ifdef FINISH_MAP
    vec3 finish_texel = texture(finish_map, v_uv).rgb;
    occlusion = finish_texel.r;
    roughness *= finish_texel.g;
    metallic *= finish_texel.b;
#endif
    roughness = max(roughness, MIN_ROUGHNESS);
    float width = roughness * roughness;
    surface_view = -v_position * inversesqrt(dot(v_position, v_position));
    float nv = clamp(dot(normal, surface_view), 0.001, 1.0);
    vec2 texels = vec2(textureSize(reflectance_table, 0));
    vec3 table = textureLod(reflectance_table, (vec2(nv, roughness) * (texels - 1.0) + 0.5) / texels, 0.0).rgb;
    bool is_wet = depth > 0.0;
    float dielectric = is_wet ? table.g : table.b;
    surface_finish = vec4(roughness, metallic, width * width, nv);
    surface_factors = vec2(is_wet ? WATER_INDEX : AIR_INDEX, occlusion);
    surface_metal = albedo;
    surface_diffuse = albedo * ((1.0 - metallic) * (1.0 - dielectric));
    surface_gain = 1.0 + albedo * (1.0 / table.r - 1.0);
    surface_mirror = mix(vec3(dielectric), albedo * table.r * surface_gain, metallic);
}

// The share of a beam that the camera receives, pi times the BRDF; facing = normal . towards > 0.
vec3 reflected_share(vec3 normal, vec3 towards, float facing) {
    vec3 middle = towards + surface_view;
    middle *= inversesqrt(max(dot(middle, middle), 1e-12));
    float nh = dot(normal, middle);
    float square = surface_finish.z;
    float nv = surface_finish.w;
    float nl = max(facing, 1e-4);
    float peak = nh * nh * (square - 1.0) + 1.0;
    float shadowing = nl * sqrt(nv * nv * (1.0 - square) + square) + nv * sqrt(nl * nl * (1.0 - square) + square);
    float facets = 0.5 * square / (peak * peak * shadowing);
    return surface_diffuse + facets * fresnel(clamp(dot(surface_view, middle), 0.0, 1.0));
}

// The light of sun and sky that the surface reflects; the arguments are those of daylight.
vec3 material_daylight(vec3 normal, float facing, float upward, float share, float depth) {
    vec3 even = daylight(0.0, upward, share, depth);
    vec3 beam = daylight(1.0, upward, share, depth) - even;
    float mirrored_up = 2.0 * dot(normal, surface_view) * upward - dot(surface_view, v_up);
    float lobe = clamp(mirrored_up / surface_finish.x, -1.0, 1.0);
    vec3 mirrored = daylight(0.0, lobe, share, depth);
    vec3 total = surface_factors.y * (even * surface_diffuse + mirrored * surface_mirror);
    if (facing > 0.0) total += beam * (facing * reflected_share(normal, v_sun, facing));
    return total;
}
#endif
`;var zl=`// Provides: open_water(pixel, size), the radiance of open water behind a pixel; pixel counts as gl_FragCoord does.
// Needs: the small texture of physical/open_water_map.py.
// Its outer texels are at the image's corners.
uniform sampler2D open_water_map;

vec3 open_water(vec2 pixel, vec2 size) {
    vec2 texels = vec2(textureSize(open_water_map, 0));
    return textureLod(open_water_map, (pixel / size * (texels - 1.0) + 0.5) / texels, 0.0).rgb;
}
`;var Bl=`// Provides: the block Optics, the numbers of physical water; and FAR, the range of pixels without a surface.
// Needs: nothing. Filled by physical/optics_block.py, where the same members are declared.
// Rays are in the camera frame (OpenGL axes), with z = -1, linear in gl_FragCoord.
#ifndef FAR
#define FAR 1e9
#endif
layout(std140) uniform Optics {
    vec4 absorption;       // rgb: a [1/m]; w: e0 of the whole field
    vec4 scattering;       // rgb: b [1/m]; w: k of the whole field
    vec4[2] reach;         // factors on the ranges of the levels of blur: blur_plan.py
    vec4 camera;           // y: exposure; z: middle range of the table of weights [m]
    vec4 sun_beam;         // rgb: irradiance of a level surface just below the surface by the sun
    vec4 sun_loss;         // rgb: its attenuation over depth [1/m]
    vec4 daylight_total;   // rgb: irradiance of a level surface just below the surface
    vec4 daylight_loss;    // rgb: its attenuation over depth [1/m]
    vec4 upwelling;        // rgb: share of the irradiance that comes up; w: cosine of the sun from the zenith
    vec4 phase_low;        // ln p as a polynomial of ((1 - cos) / 2)^(1/4): the lower four coefficients
    vec4 phase_high;       // the higher four
    vec4 ray_first;        // the ray at gl_FragCoord = 0
    vec4 ray_column;       // its change from column to column
    vec4 ray_row;          // its change from row to row
    vec4[4] lamp_optics;   // x: EE(half angle) - A; y: k_L; z: squared cosine of the half angle; w: 1 if it is below 90 degrees
};
`;var Wl=`// Provides: projected(dry, colour, unit_normal), the light of a surface with the projected pattern.
// Needs: varyings.glsl and projector.glsl with PROJECTOR; the textures of the pattern and of the shadow map.
// A laser replaces the light by the pattern's colour, 0 or 1 in each channel, times exp(-a d). A lamp adds
// colour p max(N.D, 0) / d^2 exp(-a d) * share of the light that no body blocks: see projector.py.
uniform sampler2DShadow projector_map;
uniform sampler2D projector_pattern;

vec3 projected(vec3 dry, vec3 colour, vec3 unit_normal) {
    vec3 map_point = v_projector_uv.xyz / v_projector_uv.w;
    vec3 towards = projector_position.xyz - v_position;
    float distance = max(length(towards), 0.01);
    float facing = dot(unit_normal, towards) / distance;
    vec2 outside = step(0.5, abs(map_point.xy - 0.5));
    if (v_projector_uv.w <= 0.1 || facing <= 0.0 || outside.x + outside.y > 0.0) return dry;
    vec4 pattern = textureLod(projector_pattern, map_point.xy, 0.0);
    if (pattern.a < 0.5) return dry;
    float share = textureLod(projector_map, vec3(map_point.xy, min(map_point.z, 1.0)), 0.0);
    vec3 transmission = exp(v_attenuation * -distance);
    if (projector_position.w < 0.5)
        return dry + colour * pattern.rgb * transmission * (share * facing / (distance * distance));
    vec3 beam = step(0.5, pattern.rgb);
    float channels = beam.r + beam.g + beam.b;
    bool is_white = min(pattern.r, min(pattern.g, pattern.b)) >= 1.0;
    return share < 0.5 || channels < 0.5 || is_white ? dry : beam * transmission;
}
`;var jl=`// Provides: the block Projector: the projector of a pattern.
// Needs: nothing. Filled by projector_light.py, where the same members are declared.
// Camera frame: OpenGL axes, metres.
layout(std140) uniform Projector {
    mat4 projector_from_camera;  // to homogeneous texture coordinates and depth in the shadow map
    vec4 projector_position;     // xyz [m]; w: 1 laser, 0 lamp
    vec4 projector_axis;         // xyz: opposite to the beam; w: offset along normals against self-shadowing, per metre of distance [1]
};
`;var Yl=`// Provides: the levels of blur after the second, each at half the resolution: texels weighed by 1, 3, 3, 1 along rows and columns.
// Needs: the textures of the levels; the switch N_LEVELS, how many there are, 1 to 6.
// Four linear look-ups are the sixteen weights; those outside the level have none.
uniform sampler2D level_0;
uniform sampler2D level_1;
uniform sampler2D level_2;
uniform sampler2D level_3;
uniform sampler2D level_4;
uniform sampler2D level_5;
layout(location = 0) out vec4[N_LEVELS] level_out;

vec4 smooth_mean(sampler2D level) {
    vec2 size = vec2(textureSize(level, 0));
    vec2 low = (2.0 * gl_FragCoord.xy - 0.75) / size;
    vec2 high = low + 1.5 / size;
    vec2 inside = step(high, vec2(1.0));
    vec4 sum = textureLod(level, low, 0.0) + inside.x * inside.y * textureLod(level, high, 0.0)
        + inside.y * textureLod(level, vec2(low.x, high.y), 0.0)
        + inside.x * textureLod(level, vec2(high.x, low.y), 0.0);
    return sum / ((1.0 + inside.x) * (1.0 + inside.y));
}

void main() {
    level_out[0] = smooth_mean(level_0);
#if N_LEVELS > 1
    level_out[1] = smooth_mean(level_1);
#endif
#if N_LEVELS > 2
    level_out[2] = smooth_mean(level_2);
#endif
#if N_LEVELS > 3
    level_out[3] = smooth_mean(level_3);
#endif
#if N_LEVELS > 4
    level_out[4] = smooth_mean(level_4);
#endif
#if N_LEVELS > 5
    level_out[5] = smooth_mean(level_5);
#endif
}
`;var ql=`// Provides: the light that levels of blur scatter, w_l (J - B), before their Gaussians.
// Needs: optics.glsl, transmission.glsl, open_water.glsl; the image of the surfaces; the switch N_LEVELS.
// The first run is at half the resolution and for one level; its last output is the mean of J - B, with the mean range as alpha, or FAR.
// The second run has the switch WIDE: it is twice as coarse, for all other levels, and reads that mean.
// J: radiance of a surface without water, B: of open water behind it. Pixels without a surface scatter nothing.
#include "optics.glsl"
#include "transmission.glsl"
#include "open_water.glsl"
uniform sampler2D surface_image;
#ifdef WIDE
#define FIRST 1
layout(location = 0) out vec4[N_LEVELS] level_out;
#else
#define FIRST 0
layout(location = 0) out vec4[N_LEVELS + 1] level_out;
#endif

vec4 scattered(int level, float range, vec3 excess) {
    return vec4(weight(1 + level, reach[level / 4][level % 4] * range) * excess, 0.0);
}

void main() {
    ivec2 size = textureSize(surface_image, 0);
    ivec2 corner = 2 * ivec2(gl_FragCoord.xy);
    vec3 sum = vec3(0.0);
    float ranges = 0.0;
    float count = 0.0;
    for (int i = 0; i < 4; ++i) {
        vec4 texel = texelFetch(surface_image, min(corner + ivec2(i % 2, i / 2), size - 1), 0);
        float is_surface = texel.a < 0.5 * FAR ? 1.0 : 0.0;
        sum += texel.rgb * is_surface;
        ranges += texel.a * is_surface;
        count += is_surface;
    }
    float range = ranges / max(count, 1.0);
#ifndef WIDE
    sum -= count * open_water(2.0 * gl_FragCoord.xy, vec2(size));
#endif
    vec3 excess = sum / 4.0;
    // no loop: WebGL's outputs have constant indices
#if N_LEVELS > 0
    level_out[0] = scattered(FIRST + 0, range, excess);
#endif
#if N_LEVELS > 1
    level_out[1] = scattered(FIRST + 1, range, excess);
#endif
#if N_LEVELS > 2
    level_out[2] = scattered(FIRST + 2, range, excess);
#endif
#if N_LEVELS > 3
    level_out[3] = scattered(FIRST + 3, range, excess);
#endif
#if N_LEVELS > 4
    level_out[4] = scattered(FIRST + 4, range, excess);
#endif
#if N_LEVELS > 5
    level_out[5] = scattered(FIRST + 5, range, excess);
#endif
#if N_LEVELS > 6
    level_out[6] = scattered(FIRST + 6, range, excess);
#endif
#ifndef WIDE
    level_out[N_LEVELS] = vec4(excess, count > 0.0 ? range : FAR);
#endif
}
`;var Xl=`// Provides: one triangle over the whole target, without depth.
// Needs: nothing; three vertices without attributes.
// For the passes of physical water that work on whole images.
void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 0.0, 1.0);
}
`;var $l=`// Provides: depth only, which the rasteriser writes.
// Needs: nothing.
// For all shadow maps.
void main() {}
`;var Kl=`// Provides: sun_share(map_point), 0 in the sun's shadow to 1 in full sunlight.
// Needs: the shadow map; map_point = texture coordinates and depth of a point in it, 0..1.
// One hardware comparison of 2 x 2 texels, or with the switch SOFT the mean of four; points outside the map are lit.
uniform sampler2DShadow shadow_map;

float sun_share(vec3 map_point) {
    vec3 inside = step(abs(map_point - 0.5), vec3(0.5));
#ifdef SOFT
    if (inside.x * inside.y * inside.z == 0.0) return 1.0;
    vec2 texel = 1.25 / vec2(textureSize(shadow_map, 0));
    float sum = 0.0;
    for (int i = -1; i <= 1; i += 2)
        for (int j = -1; j <= 1; j += 2) sum += textureLod(shadow_map, map_point + vec3(vec2(i, j) * texel, 0.0), 0.0);
    return sum / 4.0;
#else
    return inside.x * inside.y * inside.z > 0.0 ? texture(shadow_map, map_point) : 1.0;
#endif
}
`;var Ql=`// Provides: the vertices of a shadow caster in the view of a light.
// Needs: instance.glsl, filled with matrices to the light's clip space instead of the camera frame.
// Used for the shadow maps of the sun, the lamps and the projector.
#include "instance.glsl"

in vec3 vertex;

void main() {
    gl_Position = camera_from_model * vec4(vertex, 1.0);
}
`;var Jl=`// Provides: sunlit(colour, facing, mirrored, lit), the sunlight and ambient light that a surface reflects.
// Needs: varyings.glsl; facing = N.L; mirrored = R.E; lit = share of the sunlight that arrives, 0..1. N: normal,
// L: direction to the sun, R: direction of the mirrored sunlight, E: direction to the camera.
// With the switch POLISHED: surfaces are glossy, 0.3 max(R.E, 0)^32, and in the shade ambient light has the
// water's hue.
// Else UWSim's image model: q (Ia C + Id C max(N.L, 0) + Is max(R.E, 0)^2 where N.L > 0), with light rate q, surface
// colour C, and the ambient, diffuse and specular light Ia, Id, Is.
vec3 sunlit(vec3 colour, float facing, float mirrored, float lit) {
    float reached = facing > 0.0 ? lit : 0.0;
    float glint = max(mirrored, 0.0);
#ifdef POLISHED
    vec3 hue = v_water_colour.rgb / max(max(v_water_colour.r, v_water_colour.g), max(v_water_colour.b, 1e-3));
    vec3 ambient = v_lights.w * mix(0.8 + 0.35 * hue, vec3(1.0), reached);
    float narrow = glint * glint * glint * glint;
    narrow *= narrow;
    narrow *= narrow;
    narrow *= narrow;
    vec3 film = v_lights.rgb * (0.3 * narrow * reached);
    return colour * (ambient + v_lights.rgb * (facing * reached)) + film;
#endif
    return colour * (v_lights.w + v_lights.rgb * (facing * reached)) + v_water_colour.w * glint * glint * reached;
}
`;var Zl=`// Provides: colour, range and id of a surface seen through water, whichever are requested.
// Needs: varyings.glsl, instance.glsl, sun.glsl, water.glsl, grey.glsl, shadow.glsl, lamplight.glsl, projection.glsl, targets.glsl, material.glsl.
// The switch ALPHA_TEST is the alpha of holes, 1..255 of 255. EMISSION and EMISSION_MAP add emitted light, under PHYSICAL only.
// The switch OPACITY is 1..254 of 255; without it the surface is opaque. The renderer blends.
// Light, then attenuation, then fog, on stored values; noise and conversion to 8 bit follow in noise.py.
#define VARYING in
#include "varyings.glsl"
#include "targets.glsl"
#ifdef IDS
#include "instance.glsl"
#endif
#ifdef COLOUR
#ifdef PHYSICAL
#include "optics.glsl"
#include "daylight.glsl"
#ifdef SKY
#include "surface_block.glsl"
#include "skylight.glsl"
#endif
#else
#include "sun.glsl"
#include "water.glsl"
#endif
#include "grey.glsl"
#if defined(NORMAL_MAP) || defined(MICROFACET)
#include "material.glsl"
#endif
#ifdef EMISSION_MAP
uniform sampler2D emission_map;
#endif
#ifdef SHADOWS
#include "shadow.glsl"
#endif
#ifdef LAMPS
#include "lamps.glsl"
#include "lamplight.glsl"
#endif
#ifdef PROJECTOR
#include "projector.glsl"
#include "projection.glsl"
#endif
#endif
#if defined(TEXTURED) && (defined(COLOUR) || defined(ALPHA_TEST))
uniform sampler2D base_map;
#endif

void main() {
#ifdef ALPHA_TEST
    vec4 base = texture(base_map, v_uv);
    if (base.a < float(ALPHA_TEST) / 255.0) discard;
#endif
#if defined(COLOUR) || defined(RANGE)
    float range = length(v_position);
#endif
#ifdef COLOUR
    vec3 colour = v_base_colour;
#ifdef ALPHA_TEST
    colour *= base.rgb;
#elif defined(TEXTURED)
    colour *= texture(base_map, v_uv).rgb;
#endif
    float unit = inversesqrt(max(dot(v_normal, v_normal), 1e-12));
    unit = gl_FrontFacing ? unit : -unit;
#ifdef NORMAL_MAP
    vec3 normal = mapped_normal(v_normal * unit);
    float facing = dot(normal, v_sun);
#else
    vec3 normal = v_normal * unit;
    float facing = v_terms.x * unit;
#endif
#ifdef PHYSICAL
    colour = albedo_of(colour);
#ifdef NORMAL_MAP
    float upward = dot(normal, v_up);
#else
    float upward = v_terms.w * unit;
#endif
#elif defined(NORMAL_MAP)
    float mirrored = (v_terms.y - 2.0 * facing * dot(normal, v_position)) / range;
#else
    float mirrored = (v_terms.y - 2.0 * facing * unit * dot(v_normal, v_position)) / range;
#endif
    float lit = 1.0;
#ifdef SHADOWS
    lit = sun_share(v_shadow_uv);
#endif
#ifdef FOG_CLIP
    float fog_range = v_terms.w;
#else
    float fog_range = range;
#endif
#ifdef MICROFACET
    prepare_material(colour, normal, v_terms.z);
    vec3 dry = material_daylight(normal, facing, upward, lit, v_terms.z);
#elif defined(PHYSICAL)
    vec3 dry = colour * daylight(facing, upward, lit, v_terms.z);
#else
    vec3 dry = sunlit(colour, facing, mirrored, lit);
#endif
#ifdef SKY
    if (v_terms.z < 0.0) dry = colour * skylight(normal, lit);
#endif
#ifdef LAMPS
    dry += lamplight(colour, normal);
#endif
#ifdef PROJECTOR
    dry = projected(dry, colour, normal);
#endif
#ifdef EMISSION
    vec3 emitted = v_emission;
#ifdef EMISSION_MAP
    emitted *= albedo_of(texture(emission_map, v_uv).rgb);
#endif
    dry += emitted;
#endif
#ifdef AIR
    float deeper = max(v_terms.z, v_camera_depth);
    float wet = clamp(deeper / max(deeper - min(v_terms.z, v_camera_depth), 1e-6), 0.0, 1.0);
    fog_range *= wet;
    float water_range = range * wet;
#else
    float water_range = range;
#endif
#ifdef OPACITY
    float opacity = float(OPACITY) / 255.0;
#else
    float opacity = 1.0;
#endif
#ifdef PHYSICAL
#ifdef OPACITY
    colour_out = vec4(dry, opacity);
#else
    colour_out = vec4(dry, water_range);  // the water follows in whole images: physical/development.py
#endif
#else
    colour_out = vec4(camera_colour(through_water(dry, water_range, fog_range, v_terms.z)), opacity);
#endif
#endif
#ifdef RANGE
    range_out = range;
#endif
#ifdef IDS
    id_out = identity.x;
#endif
}
`;var ec=`// Provides: the vertices of a model, in the camera frame and on the image.
// Needs: frame.glsl, instance.glsl, varyings.glsl, lamps.glsl, projector.glsl.
// Terms that are linear in space are computed here; their interpolation is exact.
#define VARYING out
#include "frame.glsl"
#include "instance.glsl"
#include "varyings.glsl"
#if defined(COLOUR) && defined(PHYSICAL)
#include "optics.glsl"
#ifdef CAUSTICS
#include "caustics_block.glsl"
#endif
#endif
#if defined(COLOUR) && defined(LAMPS)
#include "lamps.glsl"
#endif
#if defined(COLOUR) && defined(PROJECTOR)
#include "projector.glsl"
#endif

in vec3 vertex;
#ifdef COLOUR
in vec3 vertex_normal;
in vec3 tint;
#ifdef NORMAL_MAP
in vec4 tangent;
#endif
#if defined(NORMAL_MAP) || defined(MICROFACET)
in vec3 finish;
#endif
#ifdef EMISSION
in vec3 emission;
#endif
#endif
#if defined(HAS_UV) && (defined(COLOUR) || defined(ALPHA_TEST))
in vec2 uv;
#endif

void main() {
    vec4 point = camera_from_model * vec4(vertex, 1.0);
    v_position = point.xyz;
    gl_Position = clip_from_camera * point;
#if defined(HAS_UV) && (defined(COLOUR) || defined(ALPHA_TEST))
    v_uv = uv;
#endif
#ifdef COLOUR
    v_normal = mat3(camera_normals) * vertex_normal;
    v_terms.x = dot(v_normal, sun.xyz);
    v_terms.y = dot(v_position, sun.xyz);
    v_terms.z = -(dot(v_position, up.xyz) + up.w);
#ifdef PHYSICAL
    v_terms.w = dot(v_normal, up.xyz);
#else
    v_terms.w = clip_fog.y - clip_fog.x * v_position.z;
#endif
    v_base_colour = tint;
    v_attenuation = attenuation.rgb;
#ifdef PHYSICAL
    v_sun_beam = vec4(sun_beam.rgb, upwelling.w);
    v_sun_loss = sun_loss.rgb;
    v_daylight_total = daylight_total.rgb;
    v_daylight_loss = daylight_loss.rgb;
    v_upwelling = upwelling.rgb;
#ifdef CAUSTICS
    v_caustic_place = vec2(dot(v_position, caustic_x.xyz), dot(v_position, caustic_y.xyz)) + vec2(caustic_x.w, caustic_y.w);
    v_caustic_depths = caustic_depths;
    v_swell_frame = swell_frame;
    v_caustic_loss = caustic_loss.rgb;
#endif
#else
    v_lights = vec4(sunlight.rgb, ambient_specular.x);
    v_water_colour = vec4(water_colour.rgb, ambient_specular.y);
    v_fog = fog;
#endif
#ifdef NORMAL_MAP
    mat3 rotation = mat3(camera_from_model);
    vec3 along = rotation * tangent.xyz;
    v_tangent = vec4(along * inversesqrt(max(dot(along, along), 1e-12)), tangent.w * sign(determinant(rotation)));
#endif
#if defined(NORMAL_MAP) || defined(MICROFACET)
    v_sun = sun.xyz;
    v_up = up.xyz;
    v_finish = finish;
#endif
#ifdef EMISSION
    v_emission = emission;
#endif
#ifdef AIR
    v_camera_depth = -up.w;
#endif
#ifdef SHADOWS
#ifdef SOFT
    float lift = 2.5 * sun.w;  // look-ups are wider
#else
    float lift = sun.w;
#endif
    vec3 lifted = v_position + v_normal * (lift * inversesqrt(max(dot(v_normal, v_normal), 1e-12)));
    v_shadow_uv = (shadow_from_camera * vec4(lifted, 1.0)).xyz;
#endif
#ifdef LAMPS
    vec3 unit_normal = v_normal * inversesqrt(max(dot(v_normal, v_normal), 1e-12));
    for (int i = 0; i < LAMPS; ++i) {
        vec3 towards = lamp_position[i].xyz - v_position;
        float lift = lamp_light[i].w * dot(towards, lamp_axis[i].xyz) * sign(dot(unit_normal, towards));
        v_lamp_uv[i] = lamp_from_camera[i] * vec4(v_position + unit_normal * lift, 1.0);
    }
#endif
#ifdef PROJECTOR
    vec3 outwards = v_normal * inversesqrt(max(dot(v_normal, v_normal), 1e-12));
    vec3 back = projector_position.xyz - v_position;
    float raise = projector_axis.w * dot(back, projector_axis.xyz) * sign(dot(outwards, back));
    v_projector_uv = projector_from_camera * vec4(v_position + outwards * raise, 1.0);
#endif
#endif
}
`;var tc=`// Provides: the requested outputs; the switches COLOUR, RANGE and IDS are their locations, or undefined.
// Needs: nothing.
// Colour: stored values 0..1. Range: along the ray [m], inf: no surface. Id 0: no surface.
#ifdef COLOUR
layout(location = COLOUR) out vec4 colour_out;
#endif
#ifdef RANGE
layout(location = RANGE) out float range_out;
#endif
#ifdef IDS
layout(location = IDS) out uint id_out;
#endif
`;var rc=`// Provides: direct(range) and whole_field(range), shares of light that arrives; weight(row, range), the share of scattered light that
// is sharp (row 0) or blurred by a level (row 1 + level).
// Needs: optics.glsl; the table of physical/blur_weights.py.
// Direct light is neither absorbed nor scattered; the whole field is that of a wide target. Formulas: optics/transmission.py.
uniform sampler2D weight_table;

vec3 direct(float range) {
    return exp((absorption.rgb + scattering.rgb) * -range);
}

vec3 whole_field(float range) {
    vec3 absorbed = absorption.rgb * range;
    vec3 wide_loss = scattering.w * sqrt(absorbed) + vec3(absorption.w);
    return exp(-absorbed - scattering.rgb * range * wide_loss);
}

vec3 weight(int row, float range) {
    vec2 size = vec2(textureSize(weight_table, 0));
    float share = range / (range + camera.z);
    return textureLod(weight_table, vec2((share * (size.x - 1.0) + 0.5) / size.x, (float(row) + 0.5) / size.y), 0.0).rgb;
}
`;var nc=`// Provides: the varyings of a surface; VARYING is \`out\` in the vertex shader, \`in\` in the fragment shader.
// Needs: the switches COLOUR, TEXTURED, SHADOWS, AIR, PROJECTOR, and LAMPS, the number of lamps; those of material.glsl.
// Flat varyings pass on constants of the block Frame: llvmpipe reads them much faster than uniforms in each pixel.
#if defined(TEXTURED) || defined(NORMAL_MAP) || defined(FINISH_MAP) || defined(EMISSION_MAP)
#define HAS_UV
#endif
VARYING vec3 v_position;  // camera frame [m]
#if defined(HAS_UV) && (defined(COLOUR) || defined(ALPHA_TEST))
VARYING vec2 v_uv;  // texture coordinates
#endif
#ifdef COLOUR
VARYING vec3 v_normal;  // camera frame, any length
VARYING vec4 v_terms;  // x: N.L |N|; y: P.L [m] (L: to the sun, P: position); z: depth below the water's surface [m]; w: clip-space z [m], PHYSICAL: N.up |N|
flat VARYING vec3 v_base_colour;  // colour of the mesh
flat VARYING vec3 v_attenuation;  // attenuation of rgb [1/m]
#ifdef PHYSICAL
flat VARYING vec4 v_sun_beam;  // these are sun_beam, sun_loss ... of optics.glsl; w: upwelling.w
flat VARYING vec3 v_sun_loss;
flat VARYING vec3 v_daylight_total;
flat VARYING vec3 v_daylight_loss;
flat VARYING vec3 v_upwelling;
#ifdef CAUSTICS
VARYING vec2 v_caustic_place;  // where the sun's beam to the point enters the water [tiles]
flat VARYING vec4 v_caustic_depths;  // these are of caustics_block.glsl
flat VARYING vec4 v_swell_frame;
flat VARYING vec3 v_caustic_loss;
#endif
#else
flat VARYING vec4 v_lights;  // rgb: sunlight; w: ambient
flat VARYING vec4 v_water_colour;  // rgb: water colour; w: specular
flat VARYING vec4 v_fog;  // rgb: fog colour; w: density squared [1/m2]
#endif
#ifdef NORMAL_MAP
VARYING vec4 v_tangent;  // xyz: camera frame; w: 1, or -1 where the texture is mirrored
#endif
#if defined(NORMAL_MAP) || defined(MICROFACET)
flat VARYING vec3 v_sun;  // towards the sun, camera frame
flat VARYING vec3 v_up;  // W's z axis, camera frame
flat VARYING vec3 v_finish;  // x: roughness; y: share of metal; z: scale of the normal map
#endif
#ifdef EMISSION
flat VARYING vec3 v_emission;  // emitted radiance
#endif
#ifdef AIR
flat VARYING float v_camera_depth;  // depth of the camera below the water's surface [m]
#endif
#ifdef SHADOWS
VARYING vec3 v_shadow_uv;  // texture coordinates and depth in the shadow map, 0..1
#endif
#ifdef LAMPS
VARYING vec4[LAMPS] v_lamp_uv;  // homogeneous texture coordinates and depth in the lamps' shadow maps
#endif
#ifdef PROJECTOR
VARYING vec4 v_projector_uv;  // homogeneous texture coordinates and depth in the projector's shadow map
#endif
#endif
`;var sc=`// Provides: through_water(lit, range, fog_range, depth), the colour of a surface at the camera.
// Needs: varyings.glsl; the switch NO_FOG if the fog density is 0; range: along the ray in water, fog_range: distance in
// the fog, depth: below the water's surface [m].
// lit E + w (1 - E exp(-0.001 depth)) with E = exp(-2 a range), then fog with exp(-(f fog_range)^2): see water.py.
vec3 through_water(vec3 lit, float range, float fog_range, float depth) {
    vec3 transmission = exp(v_attenuation * (-2.0 * range));
    float dimmed = exp(-0.001 * max(depth, 0.0));
    vec3 colour = transmission * (lit - v_water_colour.rgb * dimmed) + v_water_colour.rgb;
#ifdef NO_FOG
    return colour;
#else
    return mix(v_fog.rgb, colour, exp(-v_fog.w * fog_range * fog_range));
#endif
}
`;var ic=`// Provides: a finished image at its place on the page; an image twice as wide and high becomes the mean of its squares of four.
// Needs: presented.vert.glsl; the image, row 0 at the top, with linear interpolation.
in vec2 v_uv;
uniform sampler2D level_0;
out vec4 colour_out;

void main() {
    colour_out = textureLod(level_0, v_uv, 0.0);
}
`;var oc=`// Provides: one triangle over the whole target, and the texture coordinates of its pixels.
// Needs: nothing; three vertices without attributes. With the switch FLIPPED, row 0 of the target is the lowest one of the image.
out vec2 v_uv;

void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    v_uv = 0.5 * corner + 0.5;
#ifdef FLIPPED
    v_uv.y = 1.0 - v_uv.y;
#endif
    gl_Position = vec4(corner, 0.0, 1.0);
}
`;var wd={"background.frag.glsl":Sl,"background.vert.glsl":Ml,"blurred.frag.glsl":Al,"blurred_rows.frag.glsl":Tl,"caustics.glsl":Rl,"caustics_block.glsl":Ll,"daylight.glsl":Pl,"developed.frag.glsl":kl,"frame.glsl":Il,"gaussian.glsl":Fl,"grey.glsl":Cl,"instance.glsl":Ol,"lamp_point.frag.glsl":Nl,"lamp_point.vert.glsl":Dl,"lamp_veil.glsl":Hl,"lamplight.glsl":Ul,"lamps.glsl":Gl,"material.glsl":Vl,"open_water.glsl":zl,"optics.glsl":Bl,"presented.frag.glsl":ic,"presented.vert.glsl":oc,"projection.glsl":Wl,"projector.glsl":jl,"reduced.frag.glsl":Yl,"scattered.frag.glsl":ql,"screen.vert.glsl":Xl,"shadow.frag.glsl":$l,"shadow.glsl":Kl,"shadow.vert.glsl":Ql,"sun.glsl":Jl,"surface.frag.glsl":Zl,"surface.vert.glsl":ec,"targets.glsl":tc,"transmission.glsl":rc,"varyings.glsl":nc,"water.glsl":sc},xd=`#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp sampler2DShadow;
`,pn={Frame:0,Instance:1,Lamps:2,Projector:3,Optics:4},pe={base_map:0,shadow_map:1,lamp_maps:2,projector_map:3,projector_pattern:4,open_water_map:5,weight_table:6,level_0:7,level_1:8,level_2:9,level_3:10,level_4:11,level_5:12,surface_image:13,normal_map:11,finish_map:12,emission_map:13,reflectance_table:14},fs={vertex:0,vertex_normal:1,uv:2,tint:3,tangent:4,finish:5,emission:6},us=class{constructor(e){this.gl=e}gl;programs=new Map;get(e,n,r=e){let s=e+JSON.stringify(n),i=this.programs.get(s);return i||this.programs.set(s,i=Ed(this.gl,e,n,r)),i}};function ac(t,e){if(e.has(t))return"";e.add(t);let n=wd[t];return n===void 0?`#error no shader file ${t}`:n.replace(/^#include "([\w.]+)"$/gm,(r,s)=>ac(s,e))}function Ed(t,e,n,r){let s=Object.entries(n).map(([o,a])=>`#define ${o} ${a}
`),i=t.createProgram();for(let[o,a]of[[t.VERTEX_SHADER,`${r}.vert.glsl`],[t.FRAGMENT_SHADER,`${e}.frag.glsl`]]){let l=t.createShader(o);t.shaderSource(l,xd+s.join("")+ac(a,new Set)),t.compileShader(l),t.attachShader(i,l)}for(let[o,a]of Object.entries(fs))t.bindAttribLocation(i,a,o);if(t.linkProgram(i),!t.getProgramParameter(i,t.LINK_STATUS)){let o=(t.getAttachedShaders(i)??[]).map(a=>t.getShaderInfoLog(a));throw new Error(`${e}: ${t.getProgramInfoLog(i)} ${o.join(" ")}`)}t.useProgram(i);for(let[o,a]of Object.entries(pn)){let l=t.getUniformBlockIndex(i,o);l!==t.INVALID_INDEX&&t.uniformBlockBinding(i,l,a)}for(let[o,a]of Object.entries(pe))t.uniform1i(t.getUniformLocation(i,o),a);return i}var lc={normal_map:"NORMAL_MAP",finish_map:"FINISH_MAP",emission_map:"EMISSION_MAP"},cc=32,Sd=[["tangent","tangents",4,"SHORT"],["finish","finish",3,"FLOAT"],["emission","emissions",3,"FLOAT"]];function Md(t,e,n){let r={};return"normal_map"in t.maps&&(r.NORMAL_MAP=1),e&&(r.MICROFACET=1,"finish_map"in t.maps&&(r.FINISH_MAP=1),t.emits&&(r.EMISSION=1),t.emits&&"emission_map"in t.maps&&(r.EMISSION_MAP=1)),n&&t.cutoff!==null&&(r.ALPHA_TEST=Math.max(1,Math.min(255,Math.round(255*t.cutoff)))),r}function uc(t,e){for(let[n,r,s,i]of Sd){let o=t[r];o&&e(n,s,i,o)}}var hs=class{constructor(e,n,r,s){this.gl=e;this.images=r;this.textures=s;this.samplers=[e.CLAMP_TO_EDGE,e.REPEAT].map(o=>{let a=e.createSampler();return e.samplerParameteri(a,e.TEXTURE_MIN_FILTER,e.LINEAR_MIPMAP_NEAREST),e.samplerParameteri(a,e.TEXTURE_MAG_FILTER,e.LINEAR),e.samplerParameteri(a,e.TEXTURE_WRAP_S,o),e.samplerParameteri(a,e.TEXTURE_WRAP_T,o),a});let{reflectance:i}=n.head;this.table=i?Ad(e,n.numbers(i)):null}gl;images;textures;samplers;table;use(e,n,r){if(!e)return n;let s=this.gl,i={...n,...Md(e,"PHYSICAL"in n,"TEXTURED"in n)};for(let[o,a]of Object.entries(e.maps)){if(!(lc[o]in i))continue;let l=Number(this.textures[a].repeats);this.bindTexture(pe[o],this.images[a]),s.bindSampler(pe[o],(r??this.samplers)[l])}return i.MICROFACET&&this.table&&this.bindTexture(pe.reflectance_table,this.table),i}release(){for(let e of Object.keys(lc))this.gl.bindSampler(pe[e],null)}bindTexture(e,n){this.gl.activeTexture(this.gl.TEXTURE0+e),this.gl.bindTexture(this.gl.TEXTURE_2D,n),this.gl.activeTexture(this.gl.TEXTURE0)}};function Ad(t,e){let n=t.createTexture();t.bindTexture(t.TEXTURE_2D,n),t.texImage2D(t.TEXTURE_2D,0,t.RGBA16F,cc,cc,0,t.RGBA,t.FLOAT,e);for(let r of[t.TEXTURE_WRAP_S,t.TEXTURE_WRAP_T])t.texParameteri(t.TEXTURE_2D,r,t.CLAMP_TO_EDGE);for(let r of[t.TEXTURE_MIN_FILTER,t.TEXTURE_MAG_FILTER])t.texParameteri(t.TEXTURE_2D,r,t.LINEAR);return n}var Gi=class{constructor(e,n,r,s,i,o,a,l){this.index=e;this.visual=n;this.body=r;this.vertexArray=s;this.texture=i;this.repeats=o;this.hasUint32Indices=a;this.pieceRows=l;this.bodyFromMesh=Re(n.matrix),this.pieces=l.map(([u,g])=>({instance:this,firstIndex:u,count:g,centre:[0,0,0],radius:0,corners:[],normal:[0,0,0],density:0}))}index;visual;body;vertexArray;texture;repeats;hasUint32Indices;pieceRows;pieces;worldFromMesh=Re(new Array(16).fill(0));normals=this.worldFromMesh;isMirrored=!1;bodyFromMesh;place(e){let n=Ie(e,this.bodyFromMesh);if(n.every((i,o)=>i===this.worldFromMesh[o]))return!1;this.worldFromMesh=n,this.normals=To(n),this.isMirrored=Xs(n)<0;let[r,s]=[fc(n),fc(this.normals)];return this.pieceRows.forEach((i,o)=>{let a=this.pieces[o];a.centre=Le(n,i.slice(2,5)),a.radius=i[5]*r;let l=[i.slice(6,9),i.slice(9,12)];a.corners=[0,1,2,3,4,5,6,7].map(g=>Le(n,[l[g>>2][0],l[g>>1&1][1],l[g&1][2]]));let u=i.slice(12,15);a.normal=he(u,u)>0?_t(In(this.normals,u)):[0,0,0],a.density=i[15]*s}),!0}};function fc(t){let e=[0,1,2].map(r=>[t[r],t[4+r],t[8+r]]),n=e.map(r=>e.reduce((s,i)=>s+Math.abs(he(r,i)),0));return Math.sqrt(Math.max(...n))}var ds=class t{constructor(e,n){this.head=e;this.gl=n}head;gl;instances=[];version=0;patterns=[];maps=null;bodies=new Map;radii=new Map;sand=[];static async load(e,n){let r=new t(n.head,e);if(r.place(new Map),!e)return r;let{meshes:s,textures:i,bodies:o,projector:a}=n.head,l=await Promise.all(i.map(({repeats:h},p)=>Rd(e,n,p,p!==a?.pattern&&h)));a&&r.patterns.push(l[a.pattern]),r.maps=new hs(e,n,l,i);let u=s.map((h,p)=>Td(e,n,p)),g=u.map(({vertexArray:h})=>h);for(let h of n.head.sand??[]){let p=n.numbers(s[h.mesh].positions);r.sand.push({heap:new cs(h,p),...u[h.mesh]})}for(let h of o)for(let p of h.visuals){let{texture:b,mesh:_}=p,w=b===null?null:l[b],A=b!==null&&i[b].repeats,L=s[_].triangles[2]==="u4",[E,R]=[r.instances.length,s[_].pieces];r.instances.push(new Gi(E,p,h.name,g[_],w,A,L,R))}return r.place(new Map),r}place(e){for(let r of this.head.bodies)this.bodies.set(r.name,e.get(r.name)??st(r.pose));let n=!1;for(let r of this.instances)n=r.place(this.body(r.body))||n;n&&(this.version+=1,this.computeRadii())}setSand(e,n){let{gl:r}=this,{heap:s,positions:i,normals:o}=this.sand[e]??{};if(!r||!s||!i||!o||!(n instanceof Float32Array?s.set(n):s.apply(n)))return;let a=s.surface();r.bindBuffer(r.ARRAY_BUFFER,i),r.bufferData(r.ARRAY_BUFFER,a.positions,r.STATIC_DRAW),r.bindBuffer(r.ARRAY_BUFFER,o),r.bufferData(r.ARRAY_BUFFER,a.normals,r.STATIC_DRAW),this.version+=1}heights(e){return this.sand[e]?.heap.heights??new Float32Array}body(e){return this.bodies.get(e)??st([0,0,0,1,0,0,0])}worldFromMount(e){let n=st(e.pose);return e.body===null?n:Ie(this.body(e.body),n)}radius(e){return this.radii.get(e.visual.part)??0}computeRadii(){let e=new Map;for(let{visual:n,pieces:r}of this.instances){let s=e.get(n.part)??[1/0,1/0,1/0,-1/0,-1/0,-1/0];for(let{centre:i,radius:o}of r)for(let a=0;a<3;++a)s[a]=Math.min(s[a],i[a]-o),s[3+a]=Math.max(s[3+a],i[a]+o);e.set(n.part,s)}for(let[n,r]of e)this.radii.set(n,Math.max(r[3]-r[0],r[4]-r[1],r[5]-r[2])/2)}};function Td(t,e,n){let r=e.head.meshes[n],s=t.createVertexArray();t.bindVertexArray(s);let i=(u,g,h,p)=>{let b=t.createBuffer();return t.bindBuffer(t.ARRAY_BUFFER,b),t.bufferData(t.ARRAY_BUFFER,p,t.STATIC_DRAW),t.enableVertexAttribArray(fs[u]),t.vertexAttribPointer(fs[u],g,h,h!==t.FLOAT,0,0),b},o=u=>e.numbers(u),a=i("vertex",3,t.FLOAT,o(r.positions)),l=i("vertex_normal",3,t.SHORT,o(r.normals));return i("tint",3,t.UNSIGNED_SHORT,o(r.tints)),r.uvs&&i("uv",2,t.FLOAT,o(r.uvs)),uc(r,(u,g,h,p)=>i(u,g,t[h],o(p))),t.bindBuffer(t.ELEMENT_ARRAY_BUFFER,t.createBuffer()),t.bufferData(t.ELEMENT_ARRAY_BUFFER,o(r.triangles),t.STATIC_DRAW),t.bindVertexArray(null),{vertexArray:s,positions:a,normals:l}}async function Rd(t,e,n,r){let{type:s,bytes:i}=e.head.textures[n],o=n===e.head.projector?.pattern,a=await createImageBitmap(new Blob([e.numbers(i)],{type:s}),{imageOrientation:o?"from-image":"flipY",premultiplyAlpha:"none",colorSpaceConversion:"none"}),l=t.createTexture();t.bindTexture(t.TEXTURE_2D,l),t.texImage2D(t.TEXTURE_2D,0,t.RGBA8,t.RGBA,t.UNSIGNED_BYTE,a);let u=r?t.REPEAT:t.CLAMP_TO_EDGE;return t.texParameteri(t.TEXTURE_2D,t.TEXTURE_WRAP_S,u),t.texParameteri(t.TEXTURE_2D,t.TEXTURE_WRAP_T,u),t.texParameteri(t.TEXTURE_2D,t.TEXTURE_MAG_FILTER,t.LINEAR),t.texParameteri(t.TEXTURE_2D,t.TEXTURE_MIN_FILTER,o?t.LINEAR:t.LINEAR_MIPMAP_LINEAR),o||t.generateMipmap(t.TEXTURE_2D),a.close(),l}var Ld=["#ff5a4f","#45d96b","#4aa3ff"],vn=.02,gn=11,Pd=[0,1,-1,2,-2,3,-3,4,-4,5,-5],Vi=class{constructor(e,n,r){this.context=e;this.intrinsics=r;this.cameraFromWorld=ut(n)}context;intrinsics;labelBoxes=[];cameraFromWorld;line(e,n,r=1.5,s=[]){let{context:i}=this;i.strokeStyle=n,i.lineWidth=r,i.setLineDash(s),i.beginPath();let o=null;for(let a of e){let l=Le(this.cameraFromWorld,a);if(o&&(o[2]<-vn||l[2]<-vn)){let[u,g]=[hc(o,l),hc(l,o)];i.moveTo(...this.pixel(u)),i.lineTo(...this.pixel(g))}o=l}i.stroke()}project(e){let n=Le(this.cameraFromWorld,e);return n[2]<-vn?this.pixel(n):null}label(e,n,r="#ffffff"){let s=this.project(e);if(!s)return;let{context:i}=this;i.font=`${gn}px system-ui, sans-serif`;let o=this.findSpot(s,i.measureText(n).width);if(!o)return;let[a,l]=o;Math.abs(l-s[1])>2*gn&&this.drawLeader(s,[a-2,l-gn/3],r),i.lineWidth=3,i.setLineDash([]),i.strokeStyle="rgba(0, 12, 24, 0.75)",i.strokeText(n,a,l),i.fillStyle=r,i.fillText(n,a,l)}findSpot([e,n],r){for(let s of Pd)for(let i of[e+5,e-5-r]){let o=n-5+s*(gn+3),a=[i-2,o-gn,i+r+2,o+3];if(!this.labelBoxes.some(l=>a[0]<l[2]&&a[2]>l[0]&&a[1]<l[3]&&a[3]>l[1]))return this.labelBoxes.push(a),[i,o]}return null}drawLeader(e,n,r){let{context:s}=this;s.strokeStyle=r,s.lineWidth=.75,s.setLineDash([]),s.beginPath(),s.moveTo(...e),s.lineTo(...n),s.stroke()}dot(e,n,r){let s=this.project(e);s&&(this.context.fillStyle=n,this.context.beginPath(),this.context.arc(s[0],s[1],r,0,2*Math.PI),this.context.fill())}pixel([e,n,r]){let{fx:s,fy:i,cx:o,cy:a,skew:l}=this.intrinsics;return[o+(s*e+l*n)/-r+.5,a-i*n/-r+.5]}};function hc(t,e){if(t[2]<-vn)return t;let n=(-vn-t[2])/(e[2]-t[2]);return t.map((r,s)=>r+n*(e[s]-r))}function dc(t,e,n,r,s,i,o,a){let l=new Vi(t,e,n);for(let{name:u,at:g,colour:h,lines:p}of i.markers(o.time)){for(let b of p)l.line(b,h);p.length||l.dot(g,h,3),(a.labels||!p.length)&&l.label(g,u)}if(a.trails&&kd(l,r,i,o),a.sonars)for(let u of r.sensors)Fd(l,u,s.worldFromMount(u),o);if(a.frames)Id(l,r,s,a.labels);else if(a.labels)for(let{name:u,body:g}of r.vehicles)l.label(Pe(s.body(g)),u);for(let u of o.points("contacts",["x","y","z"]))l.dot(u,"#ffb02e",4);for(let{name:u,body:g}of r.vehicles)Cd(l,u,s.body(g),o)}function kd(t,e,n,r){let s=e.vehicles.map(({body:o})=>o),i=e.bodies.filter(o=>o.vehicle===null).map(({name:o})=>o);for(let o of[...s,...i]){let a=r.poses.get(o);if(!a)continue;let l=n.trail(o,r.time);t.line([...l,Pe(a)],"rgba(255, 214, 92, 0.9)",1.5)}}function Id(t,e,n,r){let s=e.vehicles.length>1,i=new Map(e.bodies.map(({name:o,vehicle:a})=>[o,a??""]));for(let{name:o,body:a,pose:l}of e.frames){let u=n.worldFromMount({body:a,pose:l}),g=a===null?1:.25;Ld.forEach((p,b)=>{let _=[0,1,2].map(w=>w===b?g:0);t.line([Pe(u),Le(u,_)],p,2)});let h=s&&a!==null?`${i.get(a)} `:"";r&&t.label(Pe(u),h+o.split("/").at(-1))}}function Fd(t,e,n,r){let s="rgba(120, 220, 255, 0.8)",i=r.signal(`range/${e.name}`);if(e.kind==="range"){let l=i??e.reach,u=Le(n,[l,0,0]);t.line([Pe(n),u],s,1.5,i===void 0?[4,4]:[]),i!==void 0&&t.dot(u,"#78dcff",3),i!==void 0&&t.label(u,`${i.toFixed(2)} m`,"#bfeeff");return}let o=l=>e.kind==="fan"?[0,Math.sin(l),-Math.cos(l)]:[Math.cos(l),Math.sin(l),0],a=Array.from({length:33},(l,u)=>{let g=e.from+(e.to-e.from)*u/32;return Le(n,o(g).map(h=>h*e.reach))});t.line([Pe(n),...a,Pe(n)],s,1)}function Cd(t,e,n,r){let s=["x","y","z"].map(g=>r.signal(`water/${e}/${g}`)??0),i=Math.hypot(...s);if(i<.005)return;let o=Se(Pe(n),[0,0,.55]),a=Se(o,s,(.5+2*i)/i),l=[-s[1]/i,s[0]/i,0],u=Se(a,s,-.15/i);t.line([o,a],"#5ee6d0",2.5),t.line([Se(u,l,.08),a,Se(u,l,-.08)],"#5ee6d0",2.5),t.label(a,`current ${i.toFixed(2)} m/s`,"#b9fff1")}function zi(t,e,n,r,s,i){let o=n.fx/e.fx;for(let[a,l,u]of[["truth","#45f08b",[]],["estimate","#ff9f43",[6,4]]]){let g=i.points(`${a}/${e.name}`,["u","v"]);if(!(g.length<2)){t.strokeStyle=l,t.lineWidth=2,t.setLineDash([...u]),t.beginPath();for(let[h,p]of g)t.lineTo(r+n.cx+(h-e.cx)*o+.5,s+n.cy+(p-e.cy)*o+.5);t.closePath(),t.stroke(),t.setLineDash([])}}}function mc(t,e,n,r){let[s,i]=[28,r+22],o=Od(130*n/e.fx),a=o*e.fx/n;t.save(),t.setLineDash([]),t.shadowColor="rgba(0, 12, 24, 0.9)",t.shadowBlur=3,t.fillStyle=t.strokeStyle="#ffffff",t.textAlign="center",t.font="600 13px system-ui, sans-serif",t.fillText("N",s,i),t.beginPath(),t.moveTo(s,i+6),t.lineTo(s+8,i+28),t.lineTo(s,i+23),t.lineTo(s-8,i+28),t.closePath(),t.fill();let[l,u]=[18,i+58];t.lineWidth=2,t.beginPath(),t.moveTo(l,u-6),t.lineTo(l,u),t.lineTo(l+a,u),t.lineTo(l+a,u-6),t.stroke(),t.fillText(o<1?`${Math.round(100*o)} cm`:`${o} m`,l+a/2,u-8),t.restore()}function Od(t){let e=10**Math.floor(Math.log10(t)),n=[5,2,1].find(r=>r*e<=t*(1+1e-9))??1;return Number((n*e).toPrecision(1))}var Nd=.3,Bi=.05,Dd=Math.SQRT2,ji=Re([.5,0,0,.5,0,.5,0,.5,0,0,.5,.5,0,0,0,1]);function Hd(t){let e=[0,4,8,12].map(r=>[t[r],t[r+1],t[r+2],t[r+3]]);return[1,-1].flatMap(r=>[0,1,2].map(s=>e[3].map((i,o)=>i+r*e[s][o]))).map(r=>{let s=Math.hypot(r[0],r[1],r[2]);return r.map(i=>i/s)})}function ms(t,e){let n=Hd(e.clip),r=ut(e.worldFromCamera),s=[];for(let i of t){let o=Le(r,i.centre);if(!n.every(l=>he(l,o)+l[3]+i.radius>0))continue;let a=i.corners.map(l=>Le(r,l));n.every(l=>a.some(u=>he(l,u)+l[3]>0))&&s.push([Math.hypot(...o)+i.radius,i])}return s.sort((i,o)=>i[0]-o[0]).map(([,i])=>i)}function pc(t,e,n,r){let s=Ud(n),i=Pe(r.worldFromCamera),o=[r.worldFromCamera[2],r.worldFromCamera[6],r.worldFromCamera[10]],a=Gd(r),l=e.map(u=>{let g=u.corners.map(w=>he(Se(i,w,-1),o)),p=[Math.max(0,Math.min(...g)),Math.max(0,Math.max(...g))].flatMap(w=>a.map(A=>Se(i,A,w))),[b,_]=[Wi(u.corners,s),Wi(p,s)];return b.map(([w,A],L)=>[Math.max(w,_[L][0]),Math.min(A,_[L][1])])});return t.filter(u=>{let g=Wi(u.corners,s);return l.some(h=>[0,1].every(p=>g[p][0]<=h[p][1]+Bi&&g[p][1]>=h[p][0]-Bi)&&g[2][1]>=h[2][0]-Bi)})}function Ud(t){return t[2]<Nd?[...gc(t),t]:[[1,0,-t[0]/t[2]],[0,1,-t[1]/t[2]],t]}function Wi(t,e){return e.map(n=>{let r=t.map(s=>he(n,s));return[Math.min(...r),Math.max(...r)]})}function Gd({clip:t,worldFromCamera:e}){return[[-1,-1],[-1,1],[1,-1],[1,1]].map(([r,s])=>{let i=(s+t[6])/t[5],o=(r+t[2]-t[1]*i)/t[0];return[e[0]*o+e[1]*i-e[2],e[4]*o+e[5]*i-e[6],e[8]*o+e[9]*i-e[10]]})}function gc(t){let e=[-t[0],-t[1],-t[2]],n=_t(nt(e,Math.abs(t[2])<.9?[0,0,1]:[1,0,0]));return[n,nt(n,e)]}function vc(t,e){let n=[...gc(e),[-e[0],-e[1],-e[2]]],r=[1/0,1/0,1/0],s=[-1/0,-1/0,-1/0];for(let{centre:g,radius:h}of t)n.forEach((p,b)=>{r[b]=Math.min(r[b],he(p,g)-h),s[b]=Math.max(s[b],he(p,g)+h)});let i=Math.max(s[0]-r[0],s[1]-r[1])/2,o=20,a=[1/i,1/i,2/(s[2]+o-r[2])],l=[(r[0]+s[0])/2,(r[1]+s[1])/2,(s[2]+o+r[2])/2],u=n.flatMap((g,h)=>[g[0]*a[h],g[1]*a[h],g[2]*a[h],-a[h]*l[h]]);return[Re([...u,0,0,0,1]),2*i]}function bc(t,e){if(!(t.density>0)||he(t.normal,t.normal)===0)return!1;let n=ut(e.worldFromCamera),r=t.corners.map(h=>Le(n,h)),s=Fn(e.worldFromCamera,t.normal),i=r.map(h=>-h[2]);if(Math.min(...i)<=0)return!1;let o=Math.min(...r.map(h=>Math.abs(he(s,h)))),a=Math.max(...r.map(h=>Math.hypot(...h))),l=Math.hypot(s[0],s[1]),u=Math.min(e.intrinsics.fx,e.intrinsics.fy),g=Math.max(...i)/u*(1+l*a/o);return t.density*g<=Dd}var ps=512,yc=1024,Vd=.008,kt=512,zd=80*Math.PI/180,_c=1.02,Bd=1024,bn=class{constructor(e,n,r){this.gl=e;this.width=n;this.height=r;this.texture=e.createTexture(),e.bindTexture(e.TEXTURE_2D,this.texture),e.texStorage2D(e.TEXTURE_2D,1,e.DEPTH_COMPONENT24,n,r);for(let[s,i]of[[e.TEXTURE_COMPARE_MODE,e.COMPARE_REF_TO_TEXTURE],[e.TEXTURE_COMPARE_FUNC,e.LEQUAL],[e.TEXTURE_MIN_FILTER,e.LINEAR],[e.TEXTURE_MAG_FILTER,e.LINEAR],[e.TEXTURE_WRAP_S,e.CLAMP_TO_EDGE],[e.TEXTURE_WRAP_T,e.CLAMP_TO_EDGE]])e.texParameteri(e.TEXTURE_2D,s,i);this.buffer=e.createFramebuffer(),e.bindFramebuffer(e.FRAMEBUFFER,this.buffer),e.framebufferTexture2D(e.FRAMEBUFFER,e.DEPTH_ATTACHMENT,e.TEXTURE_2D,this.texture,0),e.drawBuffers([e.NONE]),this.begin(0,0,n,r)}gl;width;height;texture;buffer;begin(e,n,r,s){let i=this.gl;i.bindFramebuffer(i.FRAMEBUFFER,this.buffer),i.viewport(e,n,r,s),i.enable(i.SCISSOR_TEST),i.scissor(e,n,r,s),i.depthMask(!0),i.clearDepth(1),i.clear(i.DEPTH_BUFFER_BIT),i.disable(i.SCISSOR_TEST)}},gs=class{constructor(e,n,r){this.gl=e;this.programs=n;this.instanceBlocks=r;let s=[ps,yc].map(i=>[i,new bn(e,i,i)]);this.suns=Object.fromEntries(s),this.sunMap=this.suns[ps]}gl;programs;instanceBlocks;suns;sunMap;textureFromWorld=Re([1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]);lift=0;lampMaps=null;projectorMap=null;sunKey="";lampKeys=[];updateSunShadows(e,n,r){let s=`${r} ${n} ${e.map(l=>`${l.instance.index}.${l.firstIndex}`)}`;if(s===this.sunKey)return;this.sunKey=s;let[i,o]=vc(e,n),a=o/ps<=Vd?ps:yc;this.sunMap=this.suns[a],this.textureFromWorld=Ie(ji,i),this.lift=1.5*o/a,this.sunMap.begin(0,0,a,a),this.draw(e,i)}updateLampShadows(e,n,r){this.lampMaps??=new bn(this.gl,2*kt,2*kt),e.forEach(({lamp:s,worldFromLamp:i},o)=>{let a=s.shadow?`${r} ${s.half_angle} ${i}`:"none";if(a===this.lampKeys[o])return;this.lampKeys[o]=a;let[l,u]=[o%2,o>>1];this.lampMaps.begin(kt*l,kt*u,kt,kt),s.shadow&&this.drawShadowMap(i,wc(s),n)})}updateProjectorShadows(e,n,r){this.projectorMap??=new bn(this.gl,n.width,n.height),this.projectorMap.begin(0,0,n.width,n.height),this.drawShadowMap(e,n,r)}drawShadowMap(e,n,r){let s=Dr(n,!0),i=ms(r,{worldFromCamera:e,clip:s,intrinsics:n});this.draw(i.filter(yn),Ie(s,ut(e)),!0)}draw(e,n,r=!1){let s=this.gl;s.enable(s.DEPTH_TEST),s.depthFunc(s.LEQUAL),s.enable(s.POLYGON_OFFSET_FILL),s.polygonOffset(1.5,2),s.useProgram(this.programs.get("shadow",{})),this.instanceBlocks.fill(n);for(let i of e)this.instanceBlocks.drawPiece(i,r);s.disable(s.POLYGON_OFFSET_FILL)}};function yn(t){return t.instance.visual.opacity>=1}function wc(t){let e=kt/2/(_c*Math.tan(Math.min(t.half_angle,zd))),n=(kt-1)/2,[r,s]=[kt,kt];return{width:r,height:s,fx:e,fy:e,cx:n,cy:n,skew:0,near:.1,far:20}}function xc(t,e,n){let r=Bd/Math.max(n,e),s=Math.max(1,Math.round(r*e)),i=Math.max(1,Math.round(r*n)),o=Math.tan(t.fovy/2);return{width:s,height:i,fx:s/2/(o*e/n),fy:i/2/o,cx:(s-1)/2,cy:(i-1)/2,skew:0,near:.1,far:20}}function Ec(t,e){let n=new Float32Array(112),r=ut(e);return t.forEach(({lamp:s,worldFromLamp:i},o)=>{let[a,l]=[.25+.5*(o%2),.25+.5*(o>>1)],u=Re([.25,0,0,a,0,.25,0,l,0,0,.5,.5,0,0,0,1]),g=Ie(u,Dr(wc(s),!0));n.set(Bt(Ie(Ie(g,ut(i)),e)),16*o);let h=Ie(r,i),p=Math.cos(s.half_angle),b=Math.cos((1-s.softness)*s.half_angle),_=2*_c*Math.tan(s.half_angle)/kt,w=h;n.set([...Pe(w),p],64+4*o),n.set([w[2],w[6],w[10],1/Math.max(b-p,1e-5)],80+4*o),n.set([...s.colour.map(A=>A*s.intensity),1.5*_],96+4*o)}),n}function Sc(t,e,n,r){let s=Ie(ut(e),r),i=Ie(ji,Dr(n,!0)),o=ut(s);return Float32Array.from([...Bt(Ie(i,s)),...Pe(o),t.laser?1:0,o[2],o[6],o[10],1.5/Math.min(n.fx,n.fy)])}function Mc(t,e,n,r,s){let{fx:i,fy:o,cx:a,cy:l,skew:u}=e,[g,h]=[1/i,-1/o],p=u*h/i,b=h*(-.5-l),_=g*(-.5-a)-u*b/i,w=L=>L.map(E=>r*E),A=new Float32Array(76);return A.set([...t.absorption,t.field[0],...t.scattering,t.field[1],...Array.from({length:8},(L,E)=>s[E]??0),0,t.exposure,t.scale,0,...w(t.beam),0,...t.beam_loss,0,...w(t.total),0,...t.loss,0,...t.reflectance,t.sun[2],...t.phase,_,b,-1,0,g,0,0,0,-p,h,0,0]),n.forEach(({lamp:L,index:E},R)=>{let M=Math.cos(L.half_angle);A.set([...t.lamps[E],M*M,+(L.half_angle<Math.PI/2)],4*(15+R))}),A}var[Wd,jd]=[.0625,.1875],Yd=.1875,qd=24;function Ac(t,e,n){let r=Math.sqrt(t.fx*t.fy),s=Math.min(Math.round(Math.log(Math.max(.41*r,1))/Math.log(2.6)),7);if(!n||s<1)return{deviations:[],spreads:[],reach:[],highestFrequency:120};let i=(.41*r)**(1/s),o=Array.from({length:s+1},(l,u)=>i**u),a=o.map(l=>l/r);return{deviations:a,spreads:o.map($d),reach:a.map(l=>Xd(l,e,t)),highestFrequency:Math.min(120,.3*r)}}function Tc(t){return{RADIUS:Rc(t),SPREAD:Math.round(1e3*t)}}function Rc(t){return t>0?Math.min(Math.ceil(3*t),qd):0}function Xd(t,e,n){let[r,s]=[n.width/n.fx/2,n.height/n.fy/2],i=[r,s].map(a=>e.map(l=>Math.min(t*l,a)**2)),o=0;for(let a of i[0])for(let l of i[1])o+=Math.sqrt(1+a+l);return e.length**2/o}function $d(t,e){let[n,r]=[0,0];for(let i=0;i<=e;++i)n=n/4+(i<2?Wd:jd),r=r/4+Yd;let s=(t/2**(e+1))**2-n-r;return s>.01?Kd(s):0}function Kd(t){let[e,n]=[.1,2*Math.sqrt(t)+1];for(;n-e>5e-4;){let r=(e+n)/2,[s,i]=[1,0];for(let o=1;o<=Rc(r);++o){let a=2*Math.exp(-o*o/(2*r*r));s+=a,i+=a*o*o}i<t*s?e=r:n=r}return Math.round(500*(e+n))/1e3}function Lc(t,e,n){let r=new Float32Array(4*n*128),s=Math.log(e.highestFrequency/.5)/35,i=Array.from({length:36},(l,u)=>.5*Math.exp(u*s)),o=i.map(l=>Qd(t,l)),a=[0,...e.deviations].map(l=>i.map(u=>Math.exp(-2*(Math.PI*u*l)**2)));for(let l=0;l<128;++l){let u=l/127,g=t.scale*u/Math.max(1-u,1e-6);for(let h=0;h<3;++h){let[p,b]=[t.absorption[h],t.scattering[h]],_=t.field[0]+t.field[1]*Math.sqrt(p*g),[w,A]=[Math.exp(-(p+b)*g),Math.exp(-g*p-_*b*g)];if(!(A-w>1e-9))continue;let L=o.map(R=>{let M=(R/t.forward)**12;return Math.exp(g*(b*(R-(_-(1-t.forward))*M)-(p+b)))});Jd(a,L,w,A).forEach((R,M)=>r[4*(128*M+l)+h]=R)}}return r}function Qd({transform:t},e){let{values:n,min_frequency:r,max_frequency:s}=t,i=Math.log(e/r)/Math.log(s/r)*(n.length-1),o=Math.min(Math.max(Math.floor(i),0),n.length-2);return n[o]+(i-o)*(n[o+1]-n[o])}function Jd(t,e,n,r){let s=t.map(p=>[...p.map((b,_)=>b/e[_]),1e3/r]),i=[...e.map(p=>(p-n)/p),1e3*(r-n)/r],o=(p,b)=>p.reduce((_,w,A)=>_+w*b[A],0),a=s.map(p=>o(p,i)),l=s.map((p,b)=>s.map((_,w)=>o(p,_)*(b===w?1+1e-9:1))),u=t.map(()=>0),g=t.map((p,b)=>b);for(;g.length;){let p=Zd(g.map(_=>[...g.map(w=>l[_][w]),a[_]])),b=Math.min(...p);if(b>=0){g.forEach((_,w)=>u[_]=p[w]);break}g=g.filter((_,w)=>w!==p.indexOf(b))}let h=u.reduce((p,b)=>p+b,0);return h>0?u.map(p=>p*(r-n)/h):u}function Zd(t){let e=t.length;for(let r=0;r<e;++r){let s=r;for(let i=r+1;i<e;++i)Math.abs(t[i][r])>Math.abs(t[s][r])&&(s=i);[t[r],t[s]]=[t[s],t[r]];for(let i=r+1;i<e;++i){let o=t[i][r]/t[r][r];for(let a=r;a<=e;++a)t[i][a]-=o*t[r][a]}}let n=new Array(e).fill(0);for(let r=e-1;r>=0;--r){let s=t[r][e];for(let i=r+1;i<e;++i)s-=t[r][i]*n[i];n[r]=s/t[r][r]}return n}var $r=[41,31],em=Math.sqrt(1-1/1.34**2),tm=.05,rm=.1,Pc=60,kc=1e9;function Fc(t,e,n,r,s){let[i,o]=$r,a=new Float32Array(4*i*o),{fx:l,fy:u,cx:g,cy:h,skew:p,width:b,height:_}=n,w=nm(t,Math.max(r,0),s);for(let A=0;A<o;++A)for(let L=0;L<i;++L){let E=-(_*A/(o-1)-.5-h)/u,R=(b*L/(i-1)-.5-g-p*E)/l;a.set(w(In(e,_t([R,E,-1]))),4*(i*A+L))}return a}function nm(t,e,n){let{sun:r,open_water:s}=t,i=t.total.map((a,l)=>a*Math.exp(-t.loss[l]*e)),o=t.beam.map((a,l)=>Math.min(a*Math.exp(-t.beam_loss[l]*e),i[l]));return a=>{let l=a[2],u=l>0?Math.min(e/Math.max(l,1e-6),kc):kc,g=im(s.asymmetry,he(a,r)),h=.5+(.5-s.backscatter)*l/Math.sqrt(l*l+rm);return[0,1,2].map(p=>{let b=s.attenuation[p],_=o[p]*(Math.PI/r[2])*g*Ic(b*(1-l/r[2]),u),w=t.reflectance[p]*i[p],A=(h*(i[p]-o[p])+(1-h)*w)*Ic(b-t.loss[p]*l,u),L=l>0?sm(t,p,l)*Math.exp(-Math.min(b*u,700)):0;return n*(s.scattering[p]*(_+A)+L)})}}function sm(t,e,n){let r=Math.min(Math.max((n-em)/(2*tm)+.5,0),1),s=r*r*(3-2*r);return s*t.open_water.window+(1-s)*t.reflectance[e]*t.total[e]}function im(t,e){let n=t,r=Math.sqrt(1+n*n-2*n*Math.min(Math.max(e,-1),1));return(1-n*n)/(4*Math.PI*r**3)}function Ic(t,e){let n=Math.min(Math.max(t*e,-Pc),Pc);return Math.abs(n)<1e-4?e*(1-n/2):(1-Math.exp(-n))/t}var om=16,am="6e4",vs=class t{constructor(e,n,r,s){this.gl=e;this.programs=n;this.nodes=r;this.format=s?e.RGBA16F:e.RGBA32F,this.switches=s?{FAR:am}:{},this.map=this.texture($r[0],$r[1],this.format)}gl;programs;nodes;switches;format;map;tables=[];table=null;targets=new Map;static make(e,n,r){return["EXT_color_buffer_float","OES_texture_float_linear","EXT_float_blend"].every(i=>e.getExtension(i))?new t(e,n,r,!1):!e.getExtension("EXT_color_buffer_float")&&!e.getExtension("EXT_color_buffer_half_float")?null:new t(e,n,r,!0)}plan(e,n){return Ac(e,this.nodes,n)}prepare(e,n,r,s,i,o){return this.table=s.deviations.length?this.tableOf(e,s):null,this.upload(this.map,$r[0],$r[1],Fc(e,n,r,i,o)),this.targetsOf(r,s).surfaces.buffer}develop(e,n,r,s,i){let o=this.targetsOf(n,r),a=e.lamp_veil?s:0;this.bind(pe.open_water_map,this.map),this.table&&this.bind(pe.weight_table,this.table);let l=this.table?{BLUR:1}:{};return(r.spreads.length||a)&&(this.drawScattered(o,r,a),this.bind(pe.level_0,o.levels[0].total.textures[0]),l.SCATTERED=1),this.bind(pe.surface_image,o.surfaces.textures[0]),e.linear&&(l.LINEAR=1),i&&(l.GREY=1),this.draw("developed",l,o.colours),o.colours.textures[0]}present(e,n,r,{width:s,height:i},o){let{gl:a}=this;this.bind(pe.level_0,e),a.bindFramebuffer(a.FRAMEBUFFER,n),a.viewport(r[0],r[1],s,i),a.useProgram(this.programs.get("presented",o?{}:{FLIPPED:1},"presented")),a.drawArrays(a.TRIANGLES,0,3)}drawScattered({surfaces:e,sources:n,levels:r},s,i){let o=s.spreads.length;this.bind(pe.surface_image,e.textures[0]),this.draw("scattered",{N_LEVELS:Math.min(o,1)},n[0]),o>1&&(this.bind(pe.surface_image,n[0].textures[1]),this.draw("scattered",{WIDE:1,N_LEVELS:o-1},n[1]));for(let a=2;a<n.length;++a)n[a-1].textures.slice(1).forEach((l,u)=>this.bind(pe.level_0+u,l)),this.draw("reduced",{N_LEVELS:n[a].textures.length},n[a]);for(let a=r.length-1;a>=0;--a){let l=s.spreads[a]??0,u=Tc(l);this.bind(pe.level_0,n[a].textures[0]),l>0&&(this.draw("blurred_rows",{...u},r[a].rows),this.bind(pe.level_0,r[a].rows.textures[0])),a+1<r.length&&(this.bind(pe.level_1,r[a+1].total.textures[0]),u.WIDER=1),a===0&&i&&(this.bind(pe.level_2,n[0].textures.at(-1)),u.LAMPS=i),o||(u.VEIL_ONLY=1),this.draw("blurred",u,r[a].total)}}draw(e,n,r){let{gl:s}=this;s.bindFramebuffer(s.FRAMEBUFFER,r.buffer),s.viewport(0,0,r.width,r.height),s.useProgram(this.programs.get(e,{...this.switches,...n},"screen")),s.drawArrays(s.TRIANGLES,0,3)}bind(e,n){this.gl.activeTexture(this.gl.TEXTURE0+e),this.gl.bindTexture(this.gl.TEXTURE_2D,n),this.gl.activeTexture(this.gl.TEXTURE0)}tableOf(e,n){let r=n.deviations.join(),s=this.tables.find(o=>o.key===r&&o.optics===e.transform);if(s)return s.texture;this.tables.length>=om&&this.gl.deleteTexture(this.tables.shift().texture);let i=this.texture(128,9,this.format);return this.upload(i,128,9,Lc(e,n,9)),this.tables.push({optics:e.transform,key:r,texture:i}),i}targetsOf({width:e,height:n},r){let{gl:s,format:i}=this,o=r.deviations.length,a=`${e} ${n} ${o}`,l=this.targets.get(a);if(l)return l;this.targets.size>7&&this.deleteTargets();let u=s.createRenderbuffer();s.bindRenderbuffer(s.RENDERBUFFER,u),s.renderbufferStorage(s.RENDERBUFFER,s.DEPTH_COMPONENT24,e,n);let g=this.target(e,n,1,i);s.framebufferRenderbuffer(s.FRAMEBUFFER,s.DEPTH_ATTACHMENT,s.RENDERBUFFER,u),g.depth=u,l={surfaces:g,colours:this.target(e,n,1,s.RGBA8),sources:[],levels:[]};let[h,p]=[e,n];for(let b=0;b<Math.max(o,1);++b){[h,p]=[Math.ceil(h/2),Math.ceil(p/2)];let _=b===0?Math.min(o,1)+1:o-b;l.sources.push(this.target(h,p,_,i)),l.levels.push({rows:this.target(h,p,1,i),total:this.target(h,p,1,i)})}return this.targets.set(a,l),l}target(e,n,r,s){let{gl:i}=this,o=Array.from({length:r},()=>this.texture(e,n,s)),a=i.createFramebuffer();return i.bindFramebuffer(i.FRAMEBUFFER,a),o.forEach((l,u)=>i.framebufferTexture2D(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+u,i.TEXTURE_2D,l,0)),i.drawBuffers(o.map((l,u)=>i.COLOR_ATTACHMENT0+u)),{buffer:a,textures:o,width:e,height:n}}texture(e,n,r){let{gl:s}=this,i=s.createTexture();s.bindTexture(s.TEXTURE_2D,i),s.texStorage2D(s.TEXTURE_2D,1,r,e,n);for(let o of[s.TEXTURE_MIN_FILTER,s.TEXTURE_MAG_FILTER])s.texParameteri(s.TEXTURE_2D,o,s.LINEAR);for(let o of[s.TEXTURE_WRAP_S,s.TEXTURE_WRAP_T])s.texParameteri(s.TEXTURE_2D,o,s.CLAMP_TO_EDGE);return i}upload(e,n,r,s){let{gl:i}=this;i.bindTexture(i.TEXTURE_2D,e),i.texSubImage2D(i.TEXTURE_2D,0,0,0,n,r,i.RGBA,i.FLOAT,s)}deleteTargets(){let{gl:e}=this;for(let{surfaces:n,colours:r,sources:s,levels:i}of this.targets.values())for(let o of[n,r,...s,...i.flatMap(({rows:a,total:l})=>[a,l])]){for(let a of o.textures)e.deleteTexture(a);e.deleteFramebuffer(o.buffer),o.depth&&e.deleteRenderbuffer(o.depth)}this.targets.clear()}};var qi=256,bs=class{constructor(e,n){this.gl=e;this.models=n;this.values=new Float32Array(qi/4*Math.max(1,n.instances.length)),this.buffer=e.createBuffer()}gl;models;values;buffer;fill(e,n){this.models.instances.forEach((r,s)=>{let i=qi/4*s;this.values.set(Bt(Ie(e,r.worldFromMesh)),i),n&&this.values.set(Bt(Ie(n,r.normals)),i+16)}),this.gl.bindBuffer(this.gl.UNIFORM_BUFFER,this.buffer),this.gl.bufferData(this.gl.UNIFORM_BUFFER,this.values,this.gl.STREAM_DRAW)}drawPiece({instance:e,firstIndex:n,count:r},s){let i=this.gl;e.visual.two_sided?i.disable(i.CULL_FACE):i.enable(i.CULL_FACE),i.frontFace(e.isMirrored!==s?i.CW:i.CCW),i.bindBufferRange(i.UNIFORM_BUFFER,pn.Instance,this.buffer,qi*e.index,160),i.bindVertexArray(e.vertexArray);let[o,a]=e.hasUint32Indices?[i.UNSIGNED_INT,4]:[i.UNSIGNED_SHORT,2];i.drawElements(i.TRIANGLES,r,o,a*n)}};var lm=5,cm=320*240,Oc=4;function _n(t){let e=t.getExtension("WEBGL_debug_renderer_info"),n=e?String(t.getParameter(e.UNMASKED_RENDERER_WEBGL)):"";return/swiftshader|llvmpipe|software|softpipe/i.test(n)}var ys=class{constructor(e,n,r){this.gl=e;this.head=n;this.models=r;this.isSoftware=_n(e),this.programs=new us(e),this.instanceBlocks=new bs(e,r),this.shadows=new gs(e,this.programs,this.instanceBlocks);let{nodes:s}=n.water;this.development=s?vs.make(e,this.programs,s):null,this.samplers=[e.CLAMP_TO_EDGE,e.REPEAT].map(i=>{let o=e.createSampler();return e.samplerParameteri(o,e.TEXTURE_MIN_FILTER,e.LINEAR),e.samplerParameteri(o,e.TEXTURE_MAG_FILTER,e.LINEAR),e.samplerParameteri(o,e.TEXTURE_WRAP_S,i),e.samplerParameteri(o,e.TEXTURE_WRAP_T,i),o})}gl;head;models;isSoftware;programs;instanceBlocks;shadows;blocks={};samplers;development;get lacksFloats(){return!!this.head.water.nodes&&!this.development}draw(e,n,r,s=!1){e.optics&&this.development?this.drawPhysical(e,e.optics,n,r,s):this.drawSurfaces(e,n,r,s,{})}drawPhysical(e,n,r,s,i){let o=this.development,{worldFromCamera:a,water:l}=e,u=this.isSoftware&&!e.isExact,g=this.isSoftware||e.isExact||devicePixelRatio>=2?1:2,h=sn(e.intrinsics,g),p=h.width*h.height>cm,b=o.plan(h,n.blur&&!(u&&p)),_=e.lamps.slice(0,Oc),w=l.surface_height-Pe(a)[2],A=o.prepare(n,a,h,b,w,l.light_rate);this.fill("Optics",Mc(n,h,_,l.light_rate,b.reach)),this.drawSurfaces({...e,intrinsics:h,grey:!1},A,[0,0],!0,{PHYSICAL:1,...o.switches}),_.length&&this.drawLampPoints(_.length,o.switches),this.gl.disable(this.gl.DEPTH_TEST);let L=o.develop(n,h,b,_.length,e.grey===!0);o.present(L,r,s,e.intrinsics,i)}drawLampPoints(e,n){let{gl:r}=this;r.useProgram(this.programs.get("lamp_point",{COLOUR:0,LAMPS:e,...n})),r.depthMask(!1),r.enable(r.BLEND),r.blendFuncSeparate(r.ONE,r.ONE,r.ONE,r.ZERO),r.drawArrays(r.POINTS,0,e),r.disable(r.BLEND),r.depthMask(!0)}drawSurfaces(e,n,r,s,i){let{gl:o,models:a}=this,{worldFromCamera:l,intrinsics:u,water:g}=e,h=Dr(u,s),p={worldFromCamera:l,clip:h,intrinsics:u},b=a.instances.filter(R=>e.isExternal||!R.visual.hidden).flatMap(R=>R.pieces),_=ms(b,p),w={COLOUR:0,...i},A=g.fog>0;!i.PHYSICAL&&!A&&(w.NO_FOG=1),!i.PHYSICAL&&A&&g.clip&&!e.isExternal&&(w.FOG_CLIP=1),e.grey&&(w.GREY=1),e.isExternal&&Object.assign(w,{AIR:1,POLISHED:1}),e.isExternal&&!this.isSoftware&&(w.SOFT=1);let L=i.PHYSICAL?e.optics.sun:_t(this.head.suns[g.sun].direction);g.shadows&&this.updateSunShadows(b,_,L,p)&&(w.SHADOWS=1),this.lightScene(e,b,w),this.fillFrame(e,h,L),this.instanceBlocks.fill(ut(l),um(l)),o.bindFramebuffer(o.FRAMEBUFFER,n),o.viewport(r[0],r[1],u.width,u.height),o.enable(o.SCISSOR_TEST),o.scissor(r[0],r[1],u.width,u.height),o.depthMask(!0),o.clear(o.DEPTH_BUFFER_BIT),o.enable(o.DEPTH_TEST),o.depthFunc(o.LEQUAL),o.disable(o.BLEND);for(let R of _.filter(yn))this.drawPiece(R,p,w,s);this.drawBackground(e.grey?{COLOUR:0,GREY:1,...i}:{COLOUR:0,...i}),o.enable(o.BLEND),o.blendFuncSeparate(o.SRC_ALPHA,o.ONE_MINUS_SRC_ALPHA,o.ZERO,o.ONE),o.depthMask(!1);for(let R of _.filter(M=>!yn(M)).reverse()){let M=Math.round(255*R.instance.visual.opacity);M>0&&this.drawPiece(R,p,{...w,OPACITY:M},s)}this.models.maps?.release(),o.depthMask(!0),o.disable(o.BLEND),o.disable(o.SCISSOR_TEST),o.bindVertexArray(null)}updateSunShadows(e,n,r,s){let i=e.filter(a=>yn(a)&&this.models.radius(a.instance)<=lm),o=pc(i,n,r,s);return o.length&&this.shadows.updateSunShadows(o,r,this.models.version),this.bind(pe.shadow_map,this.shadows.sunMap.texture),o.length>0}lightScene(e,n,r){let s=e.lamps.slice(0,Oc);s.length&&(r.LAMPS=s.length,this.shadows.updateLampShadows(s,n,this.models.version),this.bind(pe.lamp_maps,this.shadows.lampMaps.texture),this.fill("Lamps",Ec(s,e.worldFromCamera)));let{projector:i}=this.head;if(!i)return;r.PROJECTOR=1;let{width:o,height:a}=this.head.textures[i.pattern],l=this.models.worldFromMount(i),u=xc(i,o,a);this.shadows.updateProjectorShadows(l,u,n),this.bind(pe.projector_map,this.shadows.projectorMap.texture),this.bind(pe.projector_pattern,this.models.patterns[0]),this.fill("Projector",Sc(i,l,u,e.worldFromCamera))}drawPiece(e,n,r,s){let[{gl:i},{texture:o,repeats:a,visual:l}]=[this,e.instance],u=bc(e,n)?this.samplers:null;o&&(this.bind(pe.base_map,o),i.bindSampler(pe.base_map,u&&u[Number(a)]));let g=this.models.maps.use(l.material,o?{...r,TEXTURED:1}:r,u);i.useProgram(this.programs.get("surface",g)),this.instanceBlocks.drawPiece(e,s)}drawBackground(e){let{gl:n}=this;n.bindSampler(pe.base_map,null),n.disable(n.CULL_FACE),n.bindVertexArray(null),n.useProgram(this.programs.get("background",e)),n.drawArrays(n.TRIANGLES,0,3)}fillFrame({worldFromCamera:e,intrinsics:n,water:r,optics:s},i,o){let{near:a,far:l}=n,{ambient:u,specular:g,suns:h}=this.head,p=r.light_rate,b=s?.absorption.map((E,R)=>E+s.scattering[R])??r.attenuation,_=r.follows_light===!1?1:p,[w,A]=[r.colour,r.fog_colour].map(E=>E.map(R=>_*R)),L=r.fog>0?A:w;this.fill("Frame",Float32Array.from([...Bt(i),...Bt(Ie(this.shadows.textureFromWorld,e)),e[8],e[9],e[10],Pe(e)[2]-r.surface_height,...Fn(e,o),this.shadows.lift,...h[r.sun].colour.map(E=>p*E),0,p*u,p*g,0,0,...w,0,...b,0,...A,r.fog**2,(l+a)/(l-a),-2*l*a/(l-a),0,0,...L,0]))}fill(e,n){let{gl:r}=this;this.blocks[e]??=r.createBuffer(),r.bindBuffer(r.UNIFORM_BUFFER,this.blocks[e]),r.bufferData(r.UNIFORM_BUFFER,n,r.STREAM_DRAW),r.bindBufferBase(r.UNIFORM_BUFFER,pn[e],this.blocks[e])}bind(e,n){this.gl.activeTexture(this.gl.TEXTURE0+e),this.gl.bindTexture(this.gl.TEXTURE_2D,n),this.gl.activeTexture(this.gl.TEXTURE0)}};function um(t){let e=t;return Re([e[0],e[4],e[8],0,e[1],e[5],e[9],0,e[2],e[6],e[10],0,0,0,0,1])}var fm=150,hm=2e3,dm=300,mm=100;function Nc(t){let e=document.createElement("canvas").getContext("webgl2");if(!e)return null;let n=!_n(e);return e.getExtension("WEBGL_lose_context")?.loseContext(),t.getContext("webgl2",{alpha:!1,antialias:n,powerPreference:"high-performance"})}var Xi=class{constructor(e){this.gl=e}gl;fence=null;beginTime=0;pauseEnd=0;responsiveEnd=0;begin(){this.fence&&this.gl.deleteSync(this.fence),this.fence=this.gl.fenceSync(this.gl.SYNC_GPU_COMMANDS_COMPLETE,0),this.gl.flush(),this.beginTime=performance.now()}skipPauses(){this.responsiveEnd=performance.now()+dm}isReady(e){let{gl:n,fence:r}=this,s=n.isContextLost()||e-this.beginTime>hm;return r&&(s||n.getSyncParameter(r,n.SYNC_STATUS)===n.SIGNALED)&&(n.deleteSync(r),this.fence=null,this.pauseEnd=Math.min(2*e-this.beginTime,e+mm)),!this.fence&&(e>=this.pauseEnd||e<this.responsiveEnd)}},_s=class t{constructor(e,n,r){this.gl=e;this.models=r;let s=this.head=n.head;this.media=new ns(n),this.renderer=e&&new ys(e,s,r),this.pacing=e&&_n(e)?new Xi(e):null;for(let i of s.cameras){let o=W("figure");o.append(W("figcaption",`${i.name} · redrawn, no noise`)),o.style.aspectRatio=`${i.width} / ${i.height}`,N("pictures").append(o),this.frames.push(o)}}gl;models;canvas=N("image");head;overlay=N("overlay");renderer;frames=[];images=[];pacing;media;static async make(e,n){return new t(e,n,await ds.load(e,n))}draw(e,n,r,s){let{canvas:i,head:o,models:a}=this,l=this.gl&&_n(this.gl)?1:Math.min(devicePixelRatio,2),[u,g]=[i.clientWidth,i.clientHeight];if(u===0||g===0)return null;for(let z of[i,this.overlay]){let[B,K]=[Math.round(u*l),Math.round(g*l)];(z.width!==B||z.height!==K)&&([z.width,z.height]=[B,K])}a.place(n.poses),o.sand?.forEach((z,B)=>a.setSand(B,e.sand(B,n.time)));let h=r.viewCamera(u,g),p=this.water(e,n,s),b=this.media.mediumAt(n),_=s.clear?{...p,fog:0}:p,w=s.clear?this.media.clearOptics(b):b,A=this.lamps(n),{worldFromCamera:L,isExternal:E}=h,R=sn(h.intrinsics,l),M=h.camera?.grey,X={worldFromCamera:L,intrinsics:R,water:_,optics:w,lamps:A,isExternal:E,grey:M};this.renderer?.draw(X,null,[0,0]);let k=this.overlay.getContext("2d");if(k.setTransform(l,0,0,l,0,0),k.clearRect(0,0,u,g),dc(k,L,h.intrinsics,o,a,e,n,s),h.camera&&zi(k,h.camera,h.intrinsics,0,0,n),r.mode==="map"){let z=N("hud");mc(k,h.intrinsics,r.height,z.offsetTop+z.offsetHeight)}return this.frames.forEach((z,B)=>z.hidden=o.cameras[B]===h.camera),this.drawPictures(k,{...X,water:p,optics:b,isExternal:!1},n,s,l,g),this.pacing?.begin(),h}get lacksFloats(){return this.renderer?.lacksFloats??!1}skipPauses(){this.pacing?.skipPauses()}isReady(){return this.pacing?.isReady(performance.now())??!0}image(e,n,r,s,i,o={}){let{gl:a,models:l,renderer:u}=this;if(!a||!u)return new Uint8Array;l.place(s.poses);let g=a.createFramebuffer();a.bindFramebuffer(a.FRAMEBUFFER,g);let h=[a.createRenderbuffer(),a.createRenderbuffer()];[a.RGBA8,a.DEPTH_COMPONENT24].forEach((E,R)=>{a.bindRenderbuffer(a.RENDERBUFFER,h[R]),a.renderbufferStorage(a.RENDERBUFFER,E,e.width,e.height);let M=R?a.DEPTH_ATTACHMENT:a.COLOR_ATTACHMENT0;a.framebufferRenderbuffer(a.FRAMEBUFFER,M,a.RENDERBUFFER,h[R])});let{isExternal:p=!1,isClear:b,grey:_}=o,w=this.media.mediumAt(s),A={worldFromCamera:n,intrinsics:e,lamps:this.lamps(s),isExternal:p,isExact:!0,grey:_,optics:b?this.media.clearOptics(w):w,water:{...this.water(r,s,i),...o.water,...b?{fog:0}:{}}};u.draw(A,g,[0,0],!0);let L=new Uint8Array(4*e.width*e.height);a.readPixels(0,0,e.width,e.height,a.RGBA,a.UNSIGNED_BYTE,L);for(let E of h)a.deleteRenderbuffer(E);return a.deleteFramebuffer(g),L}pictureWidth(){let e=this.head.cameras.map(({width:n,height:r})=>n/r);return Math.round(fm*Math.max(...e)*Math.min(devicePixelRatio,2))}show(e,n){this.frames[e]&&(this.images[e]?this.images[e].close():this.frames[e].querySelector("figcaption").textContent=this.head.cameras[e].name,this.images[e]=n)}drawPictures(e,n,r,s,i,o){if(N("pictures").hidden=!s.pictures,!s.pictures)return;let a=this.canvas.getBoundingClientRect();this.head.cameras.forEach((l,u)=>{if(this.frames[u].hidden)return;let g=this.frames[u].getBoundingClientRect(),[h,p]=[g.left-a.left+1,g.top-a.top+1],b=Ui(l,g.width-2,g.height-2);if(this.images[u])e.drawImage(this.images[u],h,p,g.width-2,g.height-2);else{let _=this.models.worldFromMount(l),w=[Math.round(h*i),Math.round((o-p-g.height+2)*i)],{grey:A}=l,L={...n,worldFromCamera:_,intrinsics:sn(b,i),grey:A};this.renderer?.draw(L,null,w)}zi(e,l,b,h,p,r)})}water(e,n,r){let s=e.levels[fr(e,n.time)]?.level.values??{},{fog:i,light_rate:o}=this.head.water;return{...this.head.water,fog:n.signal("fog")??s.fog??i,light_rate:n.signal("light_rate")??s.light??o,sun:r.sun||this.head.water.sun}}lamps(e){return this.head.lamps.map((n,r)=>({lamp:n,index:r,brightness:e.signal(`lamp/${n.name}`)??Number(n.on)})).filter(({brightness:n})=>n>0).map(({lamp:n,index:r,brightness:s})=>({index:r,lamp:{...n,intensity:s*n.intensity},worldFromLamp:this.models.worldFromMount(n)}))}};var wn=class{constructor(e,n,r,s={}){this.time=e;for(let[o,a]of Object.entries(s))this.poses.set(o,st(a));if(!n||!r)return;n.bodies.forEach((o,a)=>this.poses.set(o,st(r,7*a)));let i=7*n.bodies.length;n.signals.forEach((o,a)=>this.signals.set(o.name,r[i+a]))}time;poses=new Map;signals=new Map;signal(e){let n=this.signals.get(e);return n===void 0||Number.isNaN(n)?void 0:n}points(e,n){let r=[];for(let s=0;;++s){if(!this.signals.has(`${e}/${s}/${n[0]}`))return r;let i=n.map(o=>this.signal(`${e}/${s}/${o}`));i.every(o=>o!==void 0)&&r.push(i)}}};var Dc=6,ws=.2,pm=30,gm=1e4,xs=class{constructor(e){this.pack=e;let n=e.head.trials??[];this.levels=n.flatMap(({levels:r},s)=>r.map(i=>({trial:s,level:i})))}pack;isLive=!1;levels;curves=[];trial=-1;version=0;title="";motion=null;trailStart=-1/0;get start(){let e=this.levels.filter(({trial:n})=>n===this.trial);return Math.min(this.motion?.head.start??1/0,e[0]?.level.start??0)}get end(){let e=this.levels.filter(({trial:n})=>n===this.trial);return Math.max(this.motion?.end??0,...e.map(({level:n})=>n.end))}async select(e){if(e===this.trial)return;let n=this.pack.head.trials?.[e];this.trial=e,this.motion=null,this.trailStart=-1/0,this.curves=[],n&&(this.title=n.title,this.curves=n.curves.map(({name:r,unit:s,times:i,values:o,names:a,is_share:l})=>({name:r,unit:s,names:a,isFraction:l,times:Array.from(this.pack.numbers(i),u=>u/gm),values:Array.from(this.pack.numbers(o),u=>Number.isNaN(u)?null:u)})),n.motion&&(this.motion=await Io(this.pack.numbers(n.motion))))}snapshot(e){let n=this.pack.head.trials?.[this.trial]?.poses;return new wn(e,this.motion?.head??null,this.motion?.row(e)??null,n)}speed(e,n){let r=this.motion,s=r?.head.bodies.indexOf(e)??-1;if(!r||s<0)return null;let i=r.head.start+(r.head.n-1)/r.head.rate,o=Math.min(i,Math.max(n,r.head.start+ws)),a=[o-ws,o].map(l=>[...r.row(l).slice(7*s,7*s+3)]);return Hc(a[0],a[1],ws)}markers(e){let[n,r]=[this.motion,this.motion?.head.markers];if(!n||!r)return[];let s=n.rowIndex(e),i=new Map;for(let o of r.changes){if(o[0]>s)break;o.length>2?i.set(o[1],o):i.delete(o[1])}return[...i.values()].map(([,o,a,l,u])=>{let g=st(u),h=r.shapes[a].map(p=>p.map(b=>Le(g,b)));return{name:o,at:u.slice(0,3),colour:l,lines:h}})}sand(e,n){let r=this.motion?.rowIndex(n)??-1;return this.motion?.removals.filter(s=>s.heap===e&&s.row<=r)??[]}trail(e,n){let r=this.motion,s=r?.head.bodies.indexOf(e)??-1;if(!r||s<0)return[];let{rate:i,start:o,n:a}=r.head,l=Math.min(a-1,Math.floor((n-o)*i)),u=[],g=Math.max(0,Math.ceil((this.trailStart-o)*i));for(let h=g;h<=l;h+=Math.max(1,Math.round(i/Dc))){let p=h*r.columns+7*s;u.push(Array.from(r.rows.subarray(p,p+3)))}return u}clearTrails(e){this.trailStart=e}};function Hc(t,e,n){let r=Math.hypot(...e.map((s,i)=>s-t[i]))/n;return n>0&&r<pm?r:null}var Es=class{constructor(e){this.head=e;this.title=e.title}head;isLive=!0;start=0;curves=[];levels=[];trial=0;end=0;title;version=0;currentMarkers=[];heights=new Map;row=null;recentRows=[];trails=[];push(e,n){let r=this.trails.at(-1);for(e===this.end&&(this.version+=1),e<this.end&&(this.trails.length=this.recentRows.length=0),(!r||e-r.time>=1/Dc)&&this.trails.push({time:e,row:n}),this.trails.length>2e4&&this.trails.splice(0,1e4),this.recentRows.push({time:e,row:n});this.recentRows.length>2&&this.recentRows[1].time<=e-ws;)this.recentRows.shift();this.row=n,this.end=e}speed(e){let n=this.head.motion?.bodies.indexOf(e)??-1,[r,s]=[this.recentRows[0],this.recentRows.at(-1)];if(n<0||!r||!s||s.time<=r.time)return null;let i=[r,s].map(({row:o})=>[0,1,2].map(a=>o[7*n+a]));return Hc(i[0],i[1],s.time-r.time)}sample(e,n,r,s){let i=this.curves.find(o=>o.name===e);i||(i={name:e,unit:n,times:[],values:[]},this.curves.push(i)),i.times.push(r),i.values.push(s)}setLevels(e){this.levels.splice(0,this.levels.length,...e.map(n=>({trial:0,level:n}))),this.version+=1}async select(){}snapshot(){return new wn(this.end,this.head.motion??null,this.row)}setMarkers(e){this.currentMarkers=e,this.version+=1}markers(){return this.currentMarkers}setSand(e,n){this.heights.set(e,n),this.version+=1}sand(e){return this.heights.get(e)??[]}trail(e){let n=this.head.motion?.bodies.indexOf(e)??-1;return n<0?[]:this.trails.map(({row:r})=>[0,1,2].map(s=>r[7*n+s]))}clearTrails(){this.trails.length=0}};var vm=.5,Ss=class{constructor(e){this.pack=e}pack;cast(e,n,r,s){let i=1;for(let o of this.pack.head.bodies){if(!o.visuals.length||s(o))continue;let a=r(o.name);for(let l of o.visuals){if(l.hidden||l.opacity<vm)continue;let u=ym(Ie(a,Re(l.matrix)));if(!u)continue;let[g,h]=[Le(u,e),Le(u,n)];i=Math.min(i,this.hitMesh(l,g,h,i))}}return i}hitMesh(e,n,r,s){let i=this.pack.head.meshes[e.mesh],o=Se(r,n,-1),a=he(o,o);for(let l of i.pieces){let u=Se([l[2],l[3],l[4]],n,-1),g=a>0?Math.min(s,Math.max(0,he(u,o)/a)):0,h=Se(u,o,-g);if(he(h,h)>l[5]*l[5])continue;let p=this.pack.numbers(i.positions),b=this.pack.numbers(i.triangles);for(let _=l[0];_<l[0]+l[1];_+=3)s=Math.min(s,bm(p,b,_,n,o))}return s}};function bm(t,e,n,r,s){let[i,o,a]=[3*e[n],3*e[n+1],3*e[n+2]],[l,u,g]=[t[i],t[i+1],t[i+2]],[h,p,b]=[t[o]-l,t[o+1]-u,t[o+2]-g],[_,w,A]=[t[a]-l,t[a+1]-u,t[a+2]-g],[L,E,R]=[s[0],s[1],s[2]],[M,X,k]=[E*A-R*w,R*_-L*A,L*w-E*_],z=h*M+p*X+b*k;if(Math.abs(z)<1e-14)return 1/0;let[B,K,q]=[r[0]-l,r[1]-u,r[2]-g],P=(B*M+K*X+q*k)/z;if(P<0||P>1)return 1/0;let[Q,D,Y]=[K*b-q*p,q*h-B*b,B*p-K*h],H=(L*Q+E*D+R*Y)/z;if(H<0||P+H>1)return 1/0;let Z=(_*Q+w*D+A*Y)/z;return Z>=0?Z:1/0}function ym(t){let e=[0,1,2].map(o=>[t[4*o],t[4*o+1],t[4*o+2]]),n=[nt(e[1],e[2]),nt(e[2],e[0]),nt(e[0],e[1])],r=he(e[0],n[0]);if(Math.abs(r)<1e-18)return null;let s=[0,1,2].map(o=>n.map(a=>a[o]/r)),i=s.map(o=>-he(o,[t[3],t[7],t[11]]));return Re([...s.flatMap((o,a)=>[...o,i[a]]),0,0,0,1])}function Gc(t){let{player:e,picture:n}=t;Object.assign(window,{uwsim:{page:t,seek:r=>t.seek(r),go:r=>t.go(r),time:()=>t.time,level:()=>fr(e,t.time),curves:()=>Object.fromEntries(e.curves.map(r=>[r.name,ki(r,t.time)])),body:r=>Array.from(n.models.body(r)),markers:()=>e.markers(t.time),sand:r=>Array.from(n.models.heights(r)),image:(r,s={})=>{let i=t.pack.head.cameras.find(u=>u.name===r),o=e.snapshot(t.time);n.models.place(o.poses);let a=n.models.worldFromMount(i),l={grey:i.grey,water:s};return Uc(n.image(i,a,e,o,t.switches,l))},external:(r,s)=>{let[i]=t.pack.head.cameras,o={isExternal:!0,isClear:s},a=e.snapshot(t.time);return Uc(n.image(i,Re(r),e,a,t.switches,o))}}})}function Uc(t){let e="";for(let n=0;n<t.length;n+=8192)e+=String.fromCharCode(...t.subarray(n,n+8192));return btoa(e)}var _m="This browser does not support WebGL 2: the page shows no 3-D view, only the results (levels and curves).",wm="This browser cannot draw into floating-point textures: the page shows the fog of the scene, not its physical water.";async function xm(){let t=matchMedia("(prefers-color-scheme: dark)").matches;document.documentElement.dataset.theme=t?"dark":"light";let e=N("message");e.textContent="Loading…";try{let n=document.getElementById("pack"),r=Nc(N("image")),i=n?null:await fl(r===null),o=i?i.pack:await on(ko(n.textContent??"")),a=await _s.make(r,o),l=i?new Es(o.head):new xs(o),u=new Ss(o),g=new ls(o,l,a,new as(o.head,a.models,u),i,u);g.note=r||i?"":_m,a.lacksFloats&&(g.note=wm),e.textContent=g.note,i?.begin(g,l);let h=Number(new URLSearchParams(location.hash.slice(1)).get("level")??0);i||(await g.select(l.levels[h]?.trial??0),g.seek(l.levels[h]?l.levels[h].level.start:l.start)),Gc(g)}catch(n){throw e.textContent=n instanceof Error?n.message:String(n),n}}xm();})();
